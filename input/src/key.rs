//! Keys that a ride may use, and the bytes of a key event.
//!
//! A key event is two bytes: the key's number on the USB (HID usage page 7, the same on every system) and 1 for
//! pressed, 0 for released. Several may follow one another in a sample.

macro_rules! keys {
    ($($(#[$doc:meta])* $name:ident = $code:literal),* $(,)?) => {
        /// Key that a ride may use, by its place on the USB keyboard.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum KeyboardKey {
            $($(#[$doc])* $name = $code),*
        }

        impl KeyboardKey {
            /// All keys that a ride may use.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// Bytes of a key event.
            pub fn to_bytes(self, pressed: bool) -> [u8; 2] {
                [self as u8, u8::from(pressed)]
            }

            /// Name of the key in a set-up file.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$name => stringify!($name)),*
                }
            }

            /// Key of this name, whatever its capitals.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|key| key.name().eq_ignore_ascii_case(name))
            }

            /// Key with this number on the USB.
            pub fn from_code(code: u8) -> Option<Self> {
                match code {
                    $($code => Some(Self::$name),)*
                    _ => None,
                }
            }
        }
    };
}

keys! {
    /// The key A.
    A = 0x04,
    /// The key B.
    B = 0x05,
    /// The key C.
    C = 0x06,
    /// The key D.
    D = 0x07,
    /// The key E.
    E = 0x08,
    /// The key F.
    F = 0x09,
    /// The key G.
    G = 0x0a,
    /// The key H.
    H = 0x0b,
    /// The key I.
    I = 0x0c,
    /// The key J.
    J = 0x0d,
    /// The key K.
    K = 0x0e,
    /// The key L.
    L = 0x0f,
    /// The key M.
    M = 0x10,
    /// The key N.
    N = 0x11,
    /// The key O.
    O = 0x12,
    /// The key P.
    P = 0x13,
    /// The key Q.
    Q = 0x14,
    /// The key R.
    R = 0x15,
    /// The key S.
    S = 0x16,
    /// The key T.
    T = 0x17,
    /// The key U.
    U = 0x18,
    /// The key V.
    V = 0x19,
    /// The key W.
    W = 0x1a,
    /// The key X.
    X = 0x1b,
    /// The key Y.
    Y = 0x1c,
    /// The key Z.
    Z = 0x1d,
    /// The key 1 above the letters.
    One = 0x1e,
    /// The key 2 above the letters.
    Two = 0x1f,
    /// The key 3 above the letters.
    Three = 0x20,
    /// The key 4 above the letters.
    Four = 0x21,
    /// The key 5 above the letters.
    Five = 0x22,
    /// The key 6 above the letters.
    Six = 0x23,
    /// The key 7 above the letters.
    Seven = 0x24,
    /// The key 8 above the letters.
    Eight = 0x25,
    /// The key 9 above the letters.
    Nine = 0x26,
    /// The key 0 above the letters.
    Zero = 0x27,
    /// The enter key.
    Enter = 0x28,
    /// The escape key.
    Escape = 0x29,
    /// The tabulator key.
    Tab = 0x2b,
    /// The backspace key.
    Backspace = 0x2a,
    /// The space bar.
    Space = 0x2c,
    /// The key − above the letters.
    Minus = 0x2d,
    /// The key = above the letters.
    Equal = 0x2e,
    /// The key [ beside the letters.
    BracketLeft = 0x2f,
    /// The key ] beside the letters.
    BracketRight = 0x30,
    /// The key of the comma.
    Comma = 0x36,
    /// The key of the full stop.
    Period = 0x37,
    /// The key of the slash.
    Slash = 0x38,
    /// The key F1.
    F1 = 0x3a,
    /// The key F2.
    F2 = 0x3b,
    /// The key F3.
    F3 = 0x3c,
    /// The key F4.
    F4 = 0x3d,
    /// The key F5.
    F5 = 0x3e,
    /// The key F6.
    F6 = 0x3f,
    /// The key F7.
    F7 = 0x40,
    /// The key F8.
    F8 = 0x41,
    /// The key F9.
    F9 = 0x42,
    /// The key F10.
    F10 = 0x43,
    /// The key F11.
    F11 = 0x44,
    /// The key F12.
    F12 = 0x45,
    /// The key Home.
    Home = 0x4a,
    /// The key End.
    End = 0x4d,
    /// The key to the page before.
    PageUp = 0x4b,
    /// The key to the next page.
    PageDown = 0x4e,
    /// The arrow to the right.
    Right = 0x4f,
    /// The arrow to the left.
    Left = 0x50,
    /// The arrow downward.
    Down = 0x51,
    /// The arrow upward.
    Up = 0x52,
    /// Either shift key.
    Shift = 0xe1,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_survives_its_bytes() {
        for &key in KeyboardKey::ALL {
            assert_eq!(KeyboardKey::from_code(key.to_bytes(true)[0]), Some(key));
            assert_eq!(KeyboardKey::named(&key.name().to_lowercase()), Some(key));
        }
    }
}
