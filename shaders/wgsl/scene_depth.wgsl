// Depth of a picture as others take it: the reversed depth of a target, for another near plane.

// Texels of the target for each pixel, in z the factor of its depth.
@group(0) @binding(0) var<uniform> scale: vec4<f32>;
@group(0) @binding(1) var one: texture_depth_2d;
// A target with several samples a pixel: the nearest of them is taken.
@group(0) @binding(1) var many: texture_depth_multisampled_2d;

fn texel(at: vec4<f32>) -> vec2<i32> {
    return vec2<i32>(at.xy * scale.xy);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    return min(textureLoad(one, texel(at), 0) * scale.z, 1.0);
}

@fragment
fn fragment_many(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    var depth = 0.0;
    for (var sample = 0; sample < i32(textureNumSamples(many)); sample++) {
        depth = max(depth, textureLoad(many, texel(at), sample));
    }
    return min(depth * scale.z, 1.0);
}
