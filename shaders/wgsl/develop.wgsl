// Development of radiance into the linear light of a screen: exposure, tone, gamut.

// Curves that a pipeline is made for, so that no pixel pays for the others.
override TONE: u32 = TONE_REINHARD;
override GAMUT: u32 = GAMUT_DESATURATE;

@group(0) @binding(1) var<uniform> adaptation: AdaptationState;
@group(0) @binding(2) var<storage, read> curve: array<f32>;

fn developed(texel: vec4<f32>, exposure: f32) -> vec3<f32> {
    let exposed = clamp(sound(texel).rgb * adaptation.exposure * exposure, vec3(-BRIGHTEST), vec3(BRIGHTEST));
    return in_gamut(toned(exposed));
}
