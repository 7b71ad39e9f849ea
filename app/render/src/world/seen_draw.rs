//! Draws as they are seen: the cones of directions in which their groups lie, for leaving out what a view cannot show.

use super::draw_list::Draw;
use super::pipelines::VertexSource;
use glam::DVec3;
use physics::DirectionCone;
use scene::cut::SeenFrom;
use std::ops::Range;
use view::Sides;

/// Angle by which cones are taken to be wider than computed, radians: apparent positions are rounded to f32 where they
/// are drawn.
const MARGIN_RAD: f64 = 1e-3;

/// A draw, and the cones in which its groups are seen.
pub struct SeenDraw<'a> {
    /// Draw that is seen.
    pub draw: &'a Draw,
    /// Distance by which blended surfaces are sorted, metres.
    pub distance: f64,
    /// Cone of each group, observer's axes; `None` for a group that holds the eye. Empty if it is not known where the
    /// groups are seen.
    cones: Vec<Option<DirectionCone>>,
}

impl<'a> SeenDraw<'a> {
    /// Draws as the sights of their motions show them; `sights` are of the resting scene, then of each motion. Draws
    /// with a motion without a sight are left out. `outside`: place of the camera relative to the eye, observer's axes,
    /// metres, if it is not there.
    pub fn all(draws: &'a [Draw], sights: &[SeenFrom], outside: Option<DVec3>, source: VertexSource) -> Vec<Self> {
        draws.iter().filter_map(|draw| Self::new(draw, sights, outside, source)).collect()
    }

    fn new(draw: &'a Draw, sights: &[SeenFrom], outside: Option<DVec3>, source: VertexSource) -> Option<Self> {
        let sight = sights.get(draw.motion.map_or(0, |motion| 1 + motion))?;
        // Moving bodies are sorted by their apparent distance; resting ones by their own place, like everything in a
        // scene at rest.
        let distance = match draw.motion {
            _ if outside.is_some() => sight.apparent(draw.centre).distance(outside.unwrap_or_default()),
            Some(_) => sight.apparent(draw.centre).length(),
            None => sight.towards(draw.centre).length(),
        };
        // Keys move the corners of animated bodies, and in instant light moving bodies are where they are now.
        let resting = draw.motion.is_none() || sight.pose.is_some();
        let instant = source == VertexSource::Plain && sight.contraction.is_none();
        let known = sight.body.is_none() && (resting || !instant);
        let cone = |centre: DVec3, radius: f64| {
            let cone = match outside {
                None => sight.cone(centre, radius)?,
                Some(place) => sight.cone_from(place, centre, radius)?,
            };
            Some(DirectionCone { radius_rad: cone.radius_rad + MARGIN_RAD, ..cone })
        };
        let groups = if known { draw.groups.as_slice() } else { &[] };
        let cones = groups.iter().map(|group| cone(group.centre, group.radius)).collect();
        Some(Self { draw, distance, cones })
    }

    /// Ranges of the index buffer that a view with these sides may show. Successive groups form one range.
    pub fn ranges(&self, sides: &Sides) -> Vec<Range<u32>> {
        if self.cones.is_empty() {
            return vec![self.draw.indices.clone()];
        }
        let mut ranges: Vec<Range<u32>> = Vec::new();
        for (group, cone) in self.draw.groups.iter().zip(&self.cones) {
            if cone.is_some_and(|cone| !sides.may_show(&cone)) {
                continue;
            }
            match ranges.last_mut() {
                Some(last) if last.end == group.indices.start => last.end = group.indices.end,
                _ => ranges.push(group.indices.clone()),
            }
        }
        ranges
    }
}

#[cfg(test)]
mod tests {
    //! Law under test: what an observer sees in a picture is never left out of it, at any speed, and most of the rest
    //! is. A wrong program shows holes at the sides of pictures, or draws the whole world in each.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::super::draw_list::Group;
    use super::*;
    use glam::{DQuat, EulerRot};
    use physics::apparent::at_rest;
    use physics::{Celerity, Event, Observer};
    use std::f64::consts::TAU;
    use view::Camera;

    const SIZE: [u32; 2] = [640, 360];

    /// Numbers from 0 to 1 that look random: the fractions of multiples of an irrational number.
    struct Spread(f64);

    impl Spread {
        fn next(&mut self) -> f64 {
            self.0 = (self.0 + 0.618_033_988_749_894_9).fract();
            (self.0 * 7919.0).fract()
        }

        fn direction(&mut self) -> DVec3 {
            let turn = DQuat::from_euler(EulerRot::YXZ, TAU * self.next(), TAU * self.next(), TAU * self.next());
            turn * DVec3::NEG_Z
        }
    }

    #[test]
    fn nothing_in_a_picture_is_left_out_and_most_of_the_rest_is() {
        let mut random = Spread(0.1);
        let origin = DVec3::new(1000.0, -30.0, 5.0);
        let (mut shown, mut beside, mut left_out) = (0, 0, 0);
        for round in 0..400 {
            let rapidity = [0.0, 0.5, 1.5, 2.6, 6.0][round % 5];
            let celerity = Celerity::new(random.direction() * f64::sinh(rapidity)).unwrap();
            let event = Event { ct: 0.0, position: origin + 40.0 * random.direction() };
            let observer = Observer { event, celerity };
            let camera = Camera::looking(random.direction(), random.direction(), 0.3 + 1.8 * random.next());
            let sides = Sides::of(&camera, SIZE, 1.0);
            let sights = [SeenFrom::of(origin, &[], &observer, None)];
            for _ in 0..60 {
                let (centre, radius) = (60.0 * random.next() * random.direction(), 8.0 * random.next() * random.next());
                let group = Group { indices: 0..3, centre, radius };
                let draw = Draw { material: 0, motion: None, indices: 0..3, centre: DVec3::ZERO, groups: vec![group] };
                let seen = SeenDraw::all(std::slice::from_ref(&draw), &sights, None, VertexSource::Streams);
                let drawn = !seen[0].ranges(&sides).is_empty();
                // Whether a place of the ball is in the picture, by the exact formula and by the camera.
                let tangents = camera.tangents(SIZE);
                let places: Vec<DVec3> = (0..40).map(|_| centre + radius * random.direction()).collect();
                let in_picture = places.iter().any(|place| {
                    let direction = at_rest(&observer, origin + *place).position;
                    let eye = camera.observer_from_eye.inverse() * direction;
                    let tangent = eye.truncate() / -eye.z;
                    eye.z < 0.0 && tangent.cmpge(tangents.low).all() && tangent.cmple(tangents.high).all()
                });
                assert!(drawn || !in_picture, "a ball at {centre} of {radius} m is left out at rapidity {rapidity}");
                shown += usize::from(in_picture);
                beside += usize::from(!in_picture);
                left_out += usize::from(!drawn);
            }
        }
        assert!(shown > 3000, "only {shown} balls are in the picture");
        assert!(left_out * 10 > beside * 8, "{left_out} of {beside} balls beside the picture are left out");
    }
}
