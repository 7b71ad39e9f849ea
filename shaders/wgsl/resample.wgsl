// Shows a flat picture on a surface that is not flat: each pixel's point on the surface, seen from the eye, finds its
// place in the picture.

struct FacetUniforms {
    eye: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    forward: vec4<f32>,
    texel: vec4<f32>,
}

// True if texels are mixed, false if the nearest one is taken.
override SMOOTH: bool = true;

// Point of the surface for each pixel, room's axes, metres; w = 0 if the projector meets no surface.
@group(0) @binding(0) var points: texture_2d<f32>;
@group(0) @binding(1) var<uniform> facet: FacetUniforms;
@group(0) @binding(2) var picture: texture_2d<f32>;

fn texel_at(place: vec2<i32>) -> vec4<f32> {
    return textureLoad(picture, clamp(place, vec2(0), vec2<i32>(textureDimensions(picture)) - 1), 0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let point = textureLoad(points, vec2<i32>(at.xy), 0);
    let direction = point.xyz - facet.eye.xyz;
    let across = vec2(dot(direction, facet.right.xyz), dot(direction, facet.up.xyz));
    let ahead = dot(direction, facet.forward.xyz);
    // Leave points of other facets, and of none, untouched.
    if (point.w == 0.0 || max(abs(across.x), abs(across.y)) > facet.eye.w * ahead) {
        discard;
    }
    let place = facet.texel.xy + facet.texel.zw * across / ahead;
    if (!SMOOTH) {
        return texel_at(vec2<i32>(floor(place)));
    }
    let first = floor(place - 0.5);
    let share = place - 0.5 - first;
    let near = vec2<i32>(first);
    let above = mix(texel_at(near), texel_at(near + vec2(1, 0)), share.x);
    let below = mix(texel_at(near + vec2(0, 1)), texel_at(near + vec2(1, 1)), share.x);
    return mix(above, below, share.y);
}
