// Radiance and adaptation, as meter and display share them. Mirrors of shaders/src/layout.rs.

struct AdaptationState {
    exposure: f32,
    white: f32,
    log2_exposure: f32,
    gain: f32,
    bright: f32,
}

// The texel with finite values only: a value that is not a number becomes dark, an infinite one very bright. By bits,
// since a compiler may take every float for finite; among floats of one sign, the order is that of their bits.
fn sound(texel: vec4<f32>) -> vec4<f32> {
    let bits = bitcast<vec4<u32>>(texel);
    let magnitude = bits & vec4(0x7fffffffu);
    let limited = bitcast<vec4<f32>>((bits & vec4(0x80000000u)) | min(magnitude, vec4(BRIGHTEST_BITS)));
    return select(vec4(0.0), limited, all(magnitude <= vec4(0x7f800000u)));
}

fn luminance(rgb: vec3<f32>) -> f32 {
    return dot(rgb, LUMINANCE);
}
