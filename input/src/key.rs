//! The keys that mean something, and the bytes of a key event.
//!
//! A key event is two bytes: the key's number on the USB (HID usage page 7, the same on every
//! system) and 1 for pressed, 0 for released. Several may follow one another in a sample.

macro_rules! keys {
    ($($(#[$doc:meta])* $name:ident = $code:literal),* $(,)?) => {
        /// A key that means something, by its place on the USB keyboard.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        pub enum KeyboardKey {
            $($(#[$doc])* $name = $code),*
        }

        impl KeyboardKey {
            /// Every key.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// The bytes of a key event.
            pub fn to_bytes(self, pressed: bool) -> [u8; 2] {
                [self as u8, u8::from(pressed)]
            }

            /// The key with this number on the USB.
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
    /// A.
    A = 0x04,
    /// C.
    C = 0x06,
    /// D.
    D = 0x07,
    /// E.
    E = 0x08,
    /// F.
    F = 0x09,
    /// H.
    H = 0x0b,
    /// P.
    P = 0x13,
    /// Q.
    Q = 0x14,
    /// R.
    R = 0x15,
    /// S.
    S = 0x16,
    /// V.
    V = 0x19,
    /// W.
    W = 0x1a,
    /// 1 above the letters.
    One = 0x1e,
    /// 2 above the letters.
    Two = 0x1f,
    /// 3 above the letters.
    Three = 0x20,
    /// Backspace.
    Backspace = 0x2a,
    /// The space bar.
    Space = 0x2c,
    /// − above the letters.
    Minus = 0x2d,
    /// = above the letters.
    Equal = 0x2e,
    /// The full stop.
    Period = 0x37,
    /// F1.
    F1 = 0x3a,
    /// Arrow to the right.
    Right = 0x4f,
    /// Arrow to the left.
    Left = 0x50,
    /// Arrow down.
    Down = 0x51,
    /// Arrow up.
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
        }
    }
}
