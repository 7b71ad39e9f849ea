// The curve of an sRGB screen (IEC 61966-2-1), and the placement of a picture on it.

struct PlacementUniforms {
    origin: vec2<f32>,
    exposure: f32,
    odd: f32,
}

// True if the target does not encode by itself.
override ENCODE: bool = true;

fn srgb(linear: vec3<f32>) -> vec3<f32> {
    let curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * linear, linear <= vec3(0.0031308));
}

fn linear_of(encoded: vec3<f32>) -> vec3<f32> {
    let curve = pow((encoded + 0.055) / 1.055, vec3(2.4));
    return select(curve, encoded / 12.92, encoded <= vec3(0.04045));
}
