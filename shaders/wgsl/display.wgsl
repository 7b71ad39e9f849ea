// Turns radiance into a pixel: development, the projector's brightness, then the sRGB curve (IEC 61966-2-1).

// True if each pixel is multiplied by a factor of its own, and a value is added to it.
override GAINS: bool = false;
// Power of its light that is the screen's signal; 0 for the sRGB curve.
override SIGNAL_POWER: f32 = 0.0;

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(3) var<uniform> placement: PlacementUniforms;
@group(0) @binding(4) var gains: texture_2d<f32>;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    var linear = developed(textureLoad(radiance, vec2<i32>(at.xy - placement.origin), 0), placement.exposure);
    if (GAINS) {
        let gain = mixed_at(gains, (at.xy - placement.origin) / vec2<f32>(textureDimensions(radiance)));
        linear = clamp(linear * gain.r + gain.g, vec3(0.0), vec3(1.0));
    }
    if (ENCODE && SIGNAL_POWER > 0.0) {
        return vec4(pow(linear, vec3(SIGNAL_POWER)), 1.0);
    }
    if (ENCODE) {
        return vec4(srgb(linear), 1.0);
    }
    return vec4(linear, 1.0);
}
