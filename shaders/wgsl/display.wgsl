// From radiance to a pixel: exposure, tone, gamut, then the sRGB curve (IEC 61966-2-1).

struct Screen {
    encode: u32,
    tone: u32,
    gamut: u32,
}

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> screen: Screen;
@group(0) @binding(2) var<storage, read> adaptation: Adaptation;
@group(0) @binding(3) var<storage, read> curve: array<f32>;

fn srgb(linear: vec3<f32>) -> vec3<f32> {
    let curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * linear, linear <= vec3(0.0031308));
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = sound(textureLoad(radiance, vec2<i32>(at.xy), 0));
    let exposed = sound(texel * adaptation.exposure).rgb;
    let linear = in_gamut(screen.gamut, toned(screen.tone, exposed));
    return vec4(select(linear, srgb(linear), screen.encode == 1u), 1.0);
}
