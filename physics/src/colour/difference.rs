//! The difference of two colours: CIELAB and the CIEDE2000 colour difference.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec3Swizzles};

/// CIELAB (L*, a*, b*) of tristimulus values, seen beside this white (CIE 15:2018, 8.2.1).
pub fn lab_from_xyz(xyz: DVec3, white: DVec3) -> DVec3 {
    /// (6/29)³ and its slope: below, the cube root is replaced by its tangent.
    const LINEAR_BELOW: f64 = 216.0 / 24389.0;
    const SLOPE: f64 = 841.0 / 108.0;
    let [x, y, z] = (xyz / white)
        .to_array()
        .map(|share| if share > LINEAR_BELOW { share.cbrt() } else { SLOPE * share + 4.0 / 29.0 });
    DVec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// The CIEDE2000 difference of two colours in CIELAB; 1 is just noticeable, side by side.
///
/// *Source:* Sharma, Wu and Dalal, *The CIEDE2000 Color-Difference Formula*, Color Research and Application 30 (2005),
/// equations 2 to 22, k_L = k_C = k_H = 1.
pub fn delta_e_2000(first: DVec3, second: DVec3) -> f64 {
    /// The constant 25⁷ of the saturation.
    const TWENTY_FIVE: f64 = 6_103_515_625.0;
    let saturation = |chroma: f64| (chroma.powi(7) / (chroma.powi(7) + TWENTY_FIVE)).sqrt();

    // Stretch a* near grey, then take chroma and hue.
    let chroma_mean = 0.5 * (first.yz().length() + second.yz().length());
    let stretch = 1.5 - 0.5 * saturation(chroma_mean);
    let [plane1, plane2] = [first, second].map(|lab| DVec2::new(lab.y * stretch, lab.z));
    let [chroma1, chroma2] = [plane1.length(), plane2.length()];
    let [hue1, hue2] = [plane1, plane2].map(|plane| plane.y.atan2(plane.x).rem_euclid(TAU));

    // Take differences; hues the short way round, and none for a grey.
    let grey = chroma1 * chroma2 == 0.0;
    let apart = (hue2 - hue1).abs() > 0.5 * TAU;
    let hue_turn = match hue2 - hue1 {
        _ if grey => 0.0,
        turn if turn > 0.5 * TAU => turn - TAU,
        turn if turn < -0.5 * TAU => turn + TAU,
        turn => turn,
    };
    let lightness_difference = second.x - first.x;
    let chroma_difference = chroma2 - chroma1;
    let hue_difference = 2.0 * (chroma1 * chroma2).sqrt() * (0.5 * hue_turn).sin();

    // Take means.
    let lightness = 0.5 * (first.x + second.x);
    let chroma = 0.5 * (chroma1 + chroma2);
    let hue = match hue1 + hue2 {
        sum if grey => sum,
        sum if !apart => 0.5 * sum,
        sum if sum < TAU => 0.5 * (sum + TAU),
        sum => 0.5 * (sum - TAU),
    };

    // Weigh by how well the eye tells differences apart there.
    let cosine = |times: f64, degrees: f64| (times * hue - degrees.to_radians()).cos();
    let hue_weight =
        1.0 - 0.17 * cosine(1.0, 30.0) + 0.24 * cosine(2.0, 0.0) + 0.32 * cosine(3.0, -6.0) - 0.20 * cosine(4.0, 63.0);
    let from_middle = (lightness - 50.0).powi(2);
    let lightness_scale = 1.0 + 0.015 * from_middle / (20.0 + from_middle).sqrt();
    let chroma_scale = 1.0 + 0.045 * chroma;
    let hue_scale = 1.0 + 0.015 * chroma * hue_weight;
    let blue_turn = 30.0 * (-((hue.to_degrees() - 275.0) / 25.0).powi(2)).exp();
    let rotation = -2.0 * saturation(chroma) * (2.0 * blue_turn).to_radians().sin();

    let [l, c, h] =
        [lightness_difference / lightness_scale, chroma_difference / chroma_scale, hue_difference / hue_scale];
    (l * l + c * c + h * h + rotation * c * h).max(0.0).sqrt()
}
