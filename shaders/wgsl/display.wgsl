// From radiance to a pixel: exposure, tone, gamut, the projector's brightness, then the sRGB curve (IEC 61966-2-1).

struct Placement {
    origin: vec2<f32>,
    exposure: f32,
    ignored: f32,
}

// What a pipeline is made for, so that no pixel pays for the other curves.
override ENCODE: bool = true;
override TONE: u32 = TONE_REINHARD;
override GAMUT: u32 = GAMUT_DESATURATE;
// Each pixel is multiplied by a factor of its own.
override GAINS: bool = false;

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> adaptation: Adaptation;
@group(0) @binding(2) var<storage, read> curve: array<f32>;
@group(0) @binding(3) var<uniform> placement: Placement;
@group(0) @binding(4) var gains: texture_2d<f32>;

fn srgb(linear: vec3<f32>) -> vec3<f32> {
    let curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * linear, linear <= vec3(0.0031308));
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = vec2<i32>(at.xy - placement.origin);
    let seen = sound(textureLoad(radiance, texel, 0)).rgb;
    let exposed = clamp(seen * adaptation.exposure * placement.exposure, vec3(-BRIGHTEST), vec3(BRIGHTEST));
    var linear = in_gamut(toned(exposed));
    if (GAINS) {
        linear *= textureLoad(gains, texel, 0).rgb;
    }
    if (ENCODE) {
        return vec4(srgb(linear), 1.0);
    }
    return vec4(linear, 1.0);
}
