//! Lines cut to a rectangle before they become f32: a diagram's lines may be as long as a galaxy.

use egui::{Pos2, Rect};

/// Part of a line within a rectangle (Liang and Barsky 1984), for ends of any size; `None` if there is none, or an end
/// is not a number.
pub fn clipped(from: [f64; 2], to: [f64; 2], bounds: Rect) -> Option<[Pos2; 2]> {
    let low = [bounds.left(), bounds.top()].map(f64::from);
    let high = [bounds.right(), bounds.bottom()].map(f64::from);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let way = to[axis] - from[axis];
        if !way.is_finite() || !from[axis].is_finite() {
            return None;
        }
        if way == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((low[axis] - from[axis]) / way, (high[axis] - from[axis]) / way);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    let at = |share: f64| {
        let place = |axis: usize| (from[axis] + share * (to[axis] - from[axis])).clamp(low[axis], high[axis]) as f32;
        Pos2::new(place(0), place(1))
    };
    (enter <= leave).then(|| [at(enter), at(leave)])
}

#[cfg(test)]
mod tests {
    //! Law: a cut line lies in the rectangle and on the line, however far its ends are.

    use super::*;

    #[test]
    fn a_line_is_cut_to_the_rectangle() {
        let bounds = Rect::from_min_max(Pos2::ZERO, Pos2::new(10.0, 10.0));
        assert_eq!(clipped([-5.0, 5.0], [5.0, 5.0], bounds), Some([Pos2::new(0.0, 5.0), Pos2::new(5.0, 5.0)]));
        assert_eq!(clipped([-1e15, -1e15], [1e15, 1e15], bounds), Some([Pos2::ZERO, Pos2::new(10.0, 10.0)]));
        assert_eq!(clipped([-5.0, 0.0], [0.0, -5.0], bounds), None);
        assert_eq!(clipped([3.0, 20.0], [3.0, 30.0], bounds), None);
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(clipped([bad, 1.0], [1.0, 1.0], bounds), None);
            assert_eq!(clipped([1.0, 1.0], [1.0, bad], bounds), None);
        }
    }
}
