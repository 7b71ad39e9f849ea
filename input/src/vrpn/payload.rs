//! Payloads of the messages that are read.

use glam::{DQuat, DVec3};

use super::wire::VrpnMessage;
use crate::clock::Nanos;
use crate::head::tracked_pose::TrackedPose;
use crate::wand::held_buttons::HeldButtons;
use crate::wand::signal::MOST_AXES;

pub(super) const POSE_LENGTH: usize = 64;
pub(super) const VELOCITY_LENGTH: usize = 72;
/// Most buttons of a device, as in VRPN itself.
const MOST_BUTTONS: usize = 256;

/// Pose in a message; `None` if the payload has another length.
pub(super) fn pose(at: Nanos, message: &VrpnMessage<'_>) -> Option<TrackedPose> {
    let payload: &[u8; POSE_LENGTH] = message.payload.try_into().ok()?;
    let [x, y, z, qx, qy, qz, qw] = numbers(&payload[8..])?;
    // A server without a clock sends a time of zero.
    let measured_s = f64::from(message.seconds) + 1e-6 * f64::from(message.microseconds);
    Some(TrackedPose {
        sensor: integer(payload)?,
        at,
        measured_s: (measured_s > 0.0).then_some(measured_s),
        latency_s: None,
        position_m: DVec3::new(x, y, z),
        orientation: DQuat::from_xyzw(qx, qy, qz, qw),
        velocity_m_s: None,
    })
}

/// Sensor and velocity in a message, m/s; `None` if the payload has another length.
pub(super) fn velocity(message: &VrpnMessage<'_>) -> Option<(i32, DVec3)> {
    let payload: &[u8; VELOCITY_LENGTH] = message.payload.try_into().ok()?;
    let velocity = DVec3::from_array(numbers(&payload[8..])?);
    Some((integer(payload)?, velocity))
}

/// Button that was pressed or released; `None` if the payload is none.
pub(super) fn button(message: &VrpnMessage<'_>) -> Option<(u32, bool)> {
    let payload: &[u8; 8] = message.payload.try_into().ok()?;
    let [button, state] = [integer(&payload[..4])?, integer(&payload[4..])?];
    let button = u32::try_from(button).ok().filter(|button| (*button as usize) < MOST_BUTTONS)?;
    Some((button, state != 0))
}

/// State of all buttons; `None` if their number is not that of the payload.
pub(super) fn buttons(message: &VrpnMessage<'_>) -> Option<HeldButtons> {
    let (words, rest) = message.payload.as_chunks::<4>();
    let (count, states) = words.split_first()?;
    let count = usize::try_from(i32::from_be_bytes(*count)).ok()?;
    if !rest.is_empty() || count != states.len() || count > MOST_BUTTONS {
        return None;
    }
    let mut buttons = HeldButtons::default();
    for (button, state) in (0..).zip(states) {
        buttons.set(button, i32::from_be_bytes(*state) != 0);
    }
    Some(buttons)
}

/// Values of all analog channels; `None` if their number is not that of the payload.
pub(super) fn channels(message: &VrpnMessage<'_>) -> Option<Vec<f64>> {
    let (words, rest) = message.payload.as_chunks::<8>();
    let (count, values) = words.split_first()?;
    if !rest.is_empty() || values.len() > MOST_AXES || f64::from_be_bytes(*count) != values.len() as f64 {
        return None;
    }
    Some(values.iter().map(|value| f64::from_be_bytes(*value)).collect())
}

/// First big-endian integer of these bytes.
fn integer(bytes: &[u8]) -> Option<i32> {
    bytes.first_chunk().map(|bytes| i32::from_be_bytes(*bytes))
}

/// First `N` big-endian numbers of these bytes.
fn numbers<const N: usize>(bytes: &[u8]) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, bytes) in numbers.iter_mut().zip(bytes.as_chunks::<8>().0.get(..N)?) {
        *number = f64::from_be_bytes(*bytes);
    }
    Some(numbers)
}

#[cfg(test)]
mod tests {
    //! Law: a number of buttons or channels that is not that of the bytes is refused, whatever it claims.
    use super::*;

    fn message(payload: &[u8]) -> VrpnMessage<'_> {
        VrpnMessage { seconds: 0, microseconds: 0, sender: 1, kind: 1, payload }
    }

    #[test]
    fn buttons_are_those_of_the_payload() {
        let words = |words: &[i32]| words.iter().flat_map(|word| word.to_be_bytes()).collect::<Vec<u8>>();
        assert_eq!(button(&message(&words(&[3, 1]))), Some((3, true)));
        assert_eq!(button(&message(&words(&[255, 0]))), Some((255, false)));
        for bad in [&[3][..], &[-1, 1], &[256, 1], &[i32::MAX, 1], &[3, 1, 0]] {
            assert_eq!(button(&message(&words(bad))), None, "{bad:?}");
        }
        assert_eq!(buttons(&message(&words(&[3, 1, 0, 2]))), Some(HeldButtons(0b101)));
        assert_eq!(buttons(&message(&words(&[0]))), Some(HeldButtons(0)));
        for bad in [&[][..], &[3, 1], &[-1], &[i32::MAX, 1], &[1, 1, 1]] {
            assert_eq!(buttons(&message(&words(bad))), None, "{bad:?}");
        }
        assert_eq!(buttons(&message(&[0, 0, 0, 1, 0])), None);
    }

    #[test]
    fn channels_are_those_of_the_payload() {
        let values = |values: &[f64]| values.iter().flat_map(|value| value.to_be_bytes()).collect::<Vec<u8>>();
        assert_eq!(channels(&message(&values(&[2.0, 0.5, -1.0]))), Some(vec![0.5, -1.0]));
        for bad in [&[][..], &[2.0, 0.5], &[f64::NAN, 1.0], &[-1.0], &[1e300, 0.5], &[1.5, 0.5]] {
            assert_eq!(channels(&message(&values(bad))), None, "{bad:?}");
        }
        assert_eq!(channels(&message(&values(&vec![129.0; 130]))), None);
    }
}
