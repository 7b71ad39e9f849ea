//! Events of the mouse in the window, and their bytes.

/// Largest motion of one event: pixels of the mouse, or notches of the wheel.
const FARTHEST: f32 = 1e5;
/// Button of the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MouseButton {
    /// Left button, which turns the head.
    Left,
    /// Right button, which moves the head.
    Right,
    /// Middle button, which returns the head to its start.
    Middle,
}

impl MouseButton {
    const ALL: [Self; 3] = [Self::Left, Self::Right, Self::Middle];
}

/// Event of the mouse in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MouseEvent {
    /// A motion, pixels.
    Moved {
        /// Motion to the right, pixels.
        right: f32,
        /// Motion downward, pixels.
        down: f32,
    },
    /// A button pressed or released.
    Button {
        /// Button of the event.
        button: MouseButton,
        /// True if the button is down.
        pressed: bool,
    },
    /// The shift key pressed (true) or released.
    Shift(bool),
    /// Turn of the wheel, notches away from the user.
    Wheel(f32),
    /// Return to the start.
    Reset,
}

pub(super) const MOVED: u8 = 0;
pub(super) const BUTTON: u8 = 1;
pub(super) const SHIFT: u8 = 2;
pub(super) const WHEEL: u8 = 3;
const RESET: u8 = 4;

impl MouseEvent {
    /// Bytes of the event, numbers little-endian. Several events may follow one another.
    pub fn to_bytes(self) -> Vec<u8> {
        match self {
            Self::Moved { right, down } => [&[MOVED][..], &right.to_le_bytes(), &down.to_le_bytes()].concat(),
            Self::Button { button, pressed } => vec![BUTTON, button as u8, u8::from(pressed)],
            Self::Shift(held) => vec![SHIFT, u8::from(held)],
            Self::Wheel(ahead) => [&[WHEEL][..], &ahead.to_le_bytes()].concat(),
            Self::Reset => vec![RESET],
        }
    }

    /// Events of the bytes, up to what is no event: that is `None`, once.
    pub(crate) fn all(bytes: &[u8]) -> impl Iterator<Item = Option<Self>> {
        let mut rest = bytes;
        std::iter::from_fn(move || {
            if rest.is_empty() {
                return None;
            }
            let (event, behind) = Self::from_bytes(rest).unzip();
            rest = behind.unwrap_or_default();
            Some(event)
        })
    }

    /// First event of the bytes, and the rest; `None` if they do not begin with an event.
    fn from_bytes(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (&kind, rest) = bytes.split_first()?;
        Some(match kind {
            MOVED => {
                let (right, rest) = number(rest)?;
                let (down, rest) = number(rest)?;
                (Self::Moved { right, down }, rest)
            }
            BUTTON => {
                let (&button, rest) = rest.split_first()?;
                let (pressed, rest) = switch(rest)?;
                (Self::Button { button: *MouseButton::ALL.get(usize::from(button))?, pressed }, rest)
            }
            SHIFT => {
                let (held, rest) = switch(rest)?;
                (Self::Shift(held), rest)
            }
            WHEEL => {
                let (ahead, rest) = number(rest)?;
                (Self::Wheel(ahead), rest)
            }
            RESET => (Self::Reset, rest),
            _ => return None,
        })
    }
}

fn number(bytes: &[u8]) -> Option<(f32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    let number = f32::from_le_bytes(*number);
    (number.abs() <= FARTHEST).then_some((number, rest))
}

fn switch(bytes: &[u8]) -> Option<(bool, &[u8])> {
    match bytes.split_first()? {
        (0, rest) => Some((false, rest)),
        (1, rest) => Some((true, rest)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: MouseEvent = MouseEvent::Moved { right: 100.0, down: 0.0 };

    fn button(button: MouseButton, pressed: bool) -> MouseEvent {
        MouseEvent::Button { button, pressed }
    }

    #[test]
    fn events_survive_their_bytes() {
        let events = [
            RIGHT,
            button(MouseButton::Middle, true),
            button(MouseButton::Left, false),
            MouseEvent::Shift(true),
            MouseEvent::Wheel(-2.5),
            MouseEvent::Reset,
        ];
        let bytes: Vec<u8> = events.iter().flat_map(|event| event.to_bytes()).collect();
        let mut rest = &bytes[..];
        for event in events {
            let (found, behind) = MouseEvent::from_bytes(rest).unwrap();
            assert_eq!(found, event);
            rest = behind;
        }
        assert!(rest.is_empty());
    }
}
