// From radiance to a pixel: exposure, tone, gamut, the projector's brightness, then the sRGB curve (IEC 61966-2-1).

// What a pipeline is made for, so that no pixel pays for the other curves.
override TONE: u32 = TONE_REINHARD;
override GAMUT: u32 = GAMUT_DESATURATE;
// Each pixel is multiplied by a factor of its own, and something is added to it.
override GAINS: bool = false;

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> adaptation: Adaptation;
@group(0) @binding(2) var<storage, read> curve: array<f32>;
@group(0) @binding(3) var<uniform> placement: Placement;
@group(0) @binding(4) var gains: texture_2d<f32>;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = vec2<i32>(at.xy - placement.origin);
    let seen = sound(textureLoad(radiance, texel, 0)).rgb;
    let exposed = clamp(seen * adaptation.exposure * placement.exposure, vec3(-BRIGHTEST), vec3(BRIGHTEST));
    var linear = in_gamut(toned(exposed));
    if (GAINS) {
        let gain = textureLoad(gains, texel, 0);
        linear = clamp(linear * gain.r + gain.g, vec3(0.0), vec3(1.0));
    }
    if (ENCODE) {
        return vec4(srgb(linear), 1.0);
    }
    return vec4(linear, 1.0);
}
