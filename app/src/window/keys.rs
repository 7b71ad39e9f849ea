//! Keys of the window as keys of the ride, by their place on the keyboard rather than by their letter.

use input::Key;
use winit::keyboard::KeyCode;

/// Key of the ride at a place of the keyboard, if one is assigned.
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
    //! Law under test: every key of the ride has a place on the keyboard; one without could never be pressed.

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
