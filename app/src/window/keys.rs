//! Keys of the window as keys of the ride, by their place on the keyboard rather than by their letter.

use input::KeyboardKey;
use winit::keyboard::KeyCode;

/// Key of the ride at a place of the keyboard, if one is assigned.
pub fn key(code: KeyCode) -> Option<KeyboardKey> {
    Some(match code {
        KeyCode::KeyA => KeyboardKey::A,
        KeyCode::KeyB => KeyboardKey::B,
        KeyCode::KeyC => KeyboardKey::C,
        KeyCode::KeyD => KeyboardKey::D,
        KeyCode::KeyE => KeyboardKey::E,
        KeyCode::KeyF => KeyboardKey::F,
        KeyCode::KeyG => KeyboardKey::G,
        KeyCode::KeyH => KeyboardKey::H,
        KeyCode::KeyI => KeyboardKey::I,
        KeyCode::KeyJ => KeyboardKey::J,
        KeyCode::KeyK => KeyboardKey::K,
        KeyCode::KeyL => KeyboardKey::L,
        KeyCode::KeyM => KeyboardKey::M,
        KeyCode::KeyN => KeyboardKey::N,
        KeyCode::KeyO => KeyboardKey::O,
        KeyCode::KeyP => KeyboardKey::P,
        KeyCode::KeyQ => KeyboardKey::Q,
        KeyCode::KeyR => KeyboardKey::R,
        KeyCode::KeyS => KeyboardKey::S,
        KeyCode::KeyT => KeyboardKey::T,
        KeyCode::KeyU => KeyboardKey::U,
        KeyCode::KeyV => KeyboardKey::V,
        KeyCode::KeyW => KeyboardKey::W,
        KeyCode::KeyX => KeyboardKey::X,
        KeyCode::KeyY => KeyboardKey::Y,
        KeyCode::KeyZ => KeyboardKey::Z,
        KeyCode::Digit1 | KeyCode::Numpad1 => KeyboardKey::One,
        KeyCode::Digit2 | KeyCode::Numpad2 => KeyboardKey::Two,
        KeyCode::Digit3 | KeyCode::Numpad3 => KeyboardKey::Three,
        KeyCode::Enter | KeyCode::NumpadEnter => KeyboardKey::Enter,
        KeyCode::Tab => KeyboardKey::Tab,
        KeyCode::Backspace => KeyboardKey::Backspace,
        KeyCode::Space => KeyboardKey::Space,
        KeyCode::Minus | KeyCode::NumpadSubtract => KeyboardKey::Minus,
        KeyCode::Equal | KeyCode::NumpadAdd => KeyboardKey::Equal,
        KeyCode::Period => KeyboardKey::Period,
        KeyCode::F1 => KeyboardKey::F1,
        KeyCode::ArrowRight => KeyboardKey::Right,
        KeyCode::ArrowLeft => KeyboardKey::Left,
        KeyCode::ArrowDown => KeyboardKey::Down,
        KeyCode::ArrowUp => KeyboardKey::Up,
        KeyCode::ShiftLeft | KeyCode::ShiftRight => KeyboardKey::Shift,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    //! Law under test: every key of the ride has a place on the keyboard. A key without a place could never be
    //! pressed.

    use super::*;

    #[test]
    fn every_key_of_the_ride_has_a_place_on_the_keyboard() {
        use KeyCode::*;
        let places = [
            KeyA, KeyB, KeyC, KeyD, KeyE, KeyF, KeyG, KeyH, KeyI, KeyJ, KeyK, KeyL, KeyM, KeyN, KeyO, KeyP, KeyQ, KeyR,
            KeyS, KeyT, KeyU, KeyV, KeyW, KeyX, KeyY, KeyZ, Digit1, Digit2, Digit3, Enter, Tab, Backspace, Space,
            Minus, Equal, Period, F1, ArrowRight, ArrowLeft, ArrowDown, ArrowUp, ShiftLeft,
        ];
        for wanted in KeyboardKey::ALL {
            assert!(places.iter().any(|place| key(*place) == Some(*wanted)), "{wanted:?}");
        }
    }
}
