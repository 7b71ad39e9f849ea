//! Views of the scene's parts for a camera outside of the eye.

use glam::Vec4;
use scene::cut::SeenFrom;
use shaders::ViewUniforms;
use view::OutsideCamera;

/// Smallest scale of Doppler factors, octaves: below, all is white.
const LEAST_OCTAVES: f32 = 0.1;

/// Rings of equal delay between the eye and the camera, about.
const RINGS: f64 = 8.0;

/// Adds to the views of the resting scene and of each motion what the shader of outside views reads (`outside.wgsl`).
/// `sights` are in the same order.
pub fn outside_views(views: &mut [ViewUniforms], sights: &[SeenFrom], outside: &OutsideCamera) {
    let largest = views.iter().map(|view| view.motion.w.log2()).fold(LEAST_OCTAVES, f32::max);
    let ring = ring_width(outside.place.length());
    for (view, sight) in views.iter_mut().zip(sights) {
        let rounded = sight.place.as_vec3();
        let rest = (sight.place - rounded.as_dvec3()).as_vec3();
        (view.eye, view.eye_rest) = (rounded.extend(0.0), rest.extend(0.0));
        view.source = (sight.observer_from_group.conjugate() * outside.place).as_vec3().extend(1.0);
        view.layer = Vec4::new(view.layer.x, view.layer.y, ring as f32, largest);
    }
}

/// Width of a ring, metres: 1, 2 or 5 times a power of ten.
fn ring_width(distance: f64) -> f64 {
    let wanted = (distance / RINGS).clamp(1e-9, 1e15);
    let power = 10.0_f64.powf(wanted.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|step| step * power).rfind(|width| *width <= wanted).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    //! Law: rings are as wide as people count, and about as many between eye and camera at every scale.

    use super::*;

    #[test]
    fn rings_have_round_widths() {
        for (distance, width) in [(8.1, 1.0), (15.9, 1.0), (16.1, 2.0), (47.0, 5.0), (81.0, 10.0), (0.9, 0.1)] {
            assert!((ring_width(distance) / width - 1.0).abs() < 1e-9, "{distance}: {}", ring_width(distance));
        }
    }
}
