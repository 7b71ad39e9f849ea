//! Which key of the window is which key of the ride, by its place on the keyboard rather than its letter.

use input::Key;
use winit::keyboard::KeyCode;

/// The ride's key at a place of the keyboard, if it means anything there.
pub fn key(code: KeyCode) -> Option<Key> {
    Some(match code {
        KeyCode::KeyA => Key::A,
        KeyCode::KeyC => Key::C,
        KeyCode::KeyD => Key::D,
        KeyCode::KeyE => Key::E,
        KeyCode::KeyF => Key::F,
        KeyCode::KeyH => Key::H,
        KeyCode::KeyP => Key::P,
        KeyCode::KeyQ => Key::Q,
        KeyCode::KeyR => Key::R,
        KeyCode::KeyS => Key::S,
        KeyCode::KeyV => Key::V,
        KeyCode::KeyW => Key::W,
        KeyCode::Digit1 | KeyCode::Numpad1 => Key::One,
        KeyCode::Digit2 | KeyCode::Numpad2 => Key::Two,
        KeyCode::Digit3 | KeyCode::Numpad3 => Key::Three,
        KeyCode::Backspace => Key::Backspace,
        KeyCode::Space => Key::Space,
        KeyCode::Minus | KeyCode::NumpadSubtract => Key::Minus,
        KeyCode::Equal | KeyCode::NumpadAdd => Key::Equal,
        KeyCode::Period => Key::Period,
        KeyCode::F1 => Key::F1,
        KeyCode::ArrowRight => Key::Right,
        KeyCode::ArrowLeft => Key::Left,
        KeyCode::ArrowDown => Key::Down,
        KeyCode::ArrowUp => Key::Up,
        KeyCode::ShiftLeft | KeyCode::ShiftRight => Key::Shift,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    //! A key that no place on the keyboard reaches could never be pressed.

    use super::*;

    #[test]
    fn every_key_of_the_ride_has_a_place_on_the_keyboard() {
        use KeyCode::*;
        let places = [
            KeyA, KeyC, KeyD, KeyE, KeyF, KeyH, KeyP, KeyQ, KeyR, KeyS, KeyV, KeyW, Digit1, Digit2, Digit3, Backspace,
            Space, Minus, Equal, Period, F1, ArrowRight, ArrowLeft, ArrowDown, ArrowUp, ShiftLeft,
        ];
        for wanted in Key::ALL {
            assert!(places.iter().any(|place| key(*place) == Some(*wanted)), "{wanted:?}");
        }
    }
}
