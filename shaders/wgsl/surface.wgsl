// Draws triangles. Apparent positions come in three streams, everything else in the scene's own coordinates. The
// radiance that leaves a surface is worked out in the surface's own frame, the world's or that of a moving object,
// with the light that falls on it there.

struct MaterialUniforms {
    base_colour: vec4<f32>,
    emissive: vec4<f32>,
    carriers: vec4<f32>,
}

// Properties that a pipeline is made for: a branch on these costs nothing, and terms that a material does not have are
// not computed.
override LIT: bool = true;
override SHADOWED: bool = true;
override EMISSIVE: bool = true;
override MASKED: bool = true;
// True if a spectrum takes the colours' place: only their luminance counts.
override SPECTRAL: bool = false;
// True if emitted light has another carrier than reflected light.
override SPLIT: bool = false;
// True if the surface is mixed with the picture behind it, by alpha.
override BLENDED: bool = false;
// True if weights for the map are drawn instead of the light that an observer sees.
override MAP: bool = false;
// True if apparent positions are worked out here, but for vertices that the CPU has worked out.
override BENDS: bool = false;
// Level added to that of textures' smaller copies: below zero, a single sample a pixel shows finer detail.
override TEXTURE_BIAS: f32 = 0.0;
// True if every vertex brings its own Doppler factor, that of its own motion.
override ANIMATED: bool = false;
// True if the position of the surface is drawn instead of light, and its object: 1 + view.layer.x, which is 1 for the
// resting scene.
override PLACES: bool = false;

@group(0) @binding(2) var shadow_map: texture_depth_2d;
@group(0) @binding(3) var shadow_sampler: sampler_comparison;
@group(1) @binding(0) var<uniform> material: MaterialUniforms;
@group(1) @binding(1) var base_colour_texture: texture_2d<f32>;
@group(1) @binding(2) var base_colour_sampler: sampler;
@group(1) @binding(3) var emissive_texture: texture_2d<f32>;
@group(1) @binding(4) var emissive_sampler: sampler;

struct ApparentPosition {
    @location(0) x: f32,
    @location(1) y: f32,
    @location(2) z: f32,
}

struct Vertex {
    @location(3) world: vec3<f32>,
    @location(4) normal: vec3<f32>,
    @location(5) uv: vec2<f32>,
    @location(6) colour: vec4<f32>,
    @location(8) emissive_uv: vec2<f32>,
}

struct Fragment {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Texture coordinates of the base colour, then of the emission.
    @location(2) uv: vec4<f32>,
    @location(3) colour: vec4<f32>,
}

@vertex
fn vertex(at: ApparentPosition, in: Vertex) -> Fragment {
    var seen = vec3(at.x, at.y, at.z);
    if (BENDS) {
        seen = select(apparent_position(in.world), seen, at.x < NOT_BENT);
    }
    let clip = view.clip_from_observer * vec4(seen, 1.0);
    return Fragment(clip, in.world, in.normal, vec4(in.uv, in.emissive_uv), in.colour);
}

// The plain world: places themselves are seen.
@vertex
fn vertex_plain(in: Vertex) -> Fragment {
    let clip = view.clip_from_observer * vec4(in.world, 1.0);
    return Fragment(clip, in.world, in.normal, vec4(in.uv, in.emissive_uv), in.colour);
}

// Depth alone, at exactly the places at which light is drawn afterwards.
@vertex
fn vertex_depth(at: ApparentPosition) -> @invariant @builtin(position) vec4<f32> {
    return view.clip_from_observer * vec4(at.x, at.y, at.z, 1.0);
}

@vertex
fn vertex_plain_depth(@location(3) world: vec3<f32>) -> @invariant @builtin(position) vec4<f32> {
    return view.clip_from_observer * vec4(world, 1.0);
}

@fragment
fn fragment_depth() {}

// A fragment of an animated body: log2 D of each vertex comes in a stream of its own.
struct AnimatedFragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec4<f32>,
    @location(3) colour: vec4<f32>,
    @location(4) log2_doppler: f32,
}

@vertex
fn vertex_animated(at: ApparentPosition, in: Vertex, @location(7) log2_doppler: f32) -> AnimatedFragment {
    let clip = view.clip_from_observer * vec4(at.x, at.y, at.z, 1.0);
    return AnimatedFragment(clip, in.world, in.normal, vec4(in.uv, in.emissive_uv), in.colour, log2_doppler);
}

// Share of the sun that reaches a point: four filtered samples of the sun's depth map.
fn sunlit(world: vec3<f32>, normal: vec3<f32>) -> f32 {
    let place = lighting.shadow_from_world * vec4(world + normal * lighting.ground.w, 1.0);
    let texel = SHADOW_FILTER_TEXELS / vec2<f32>(textureDimensions(shadow_map));
    let depth = place.z + lighting.sun.w;
    var sum = 0.0;
    for (var corner = 0; corner < 4; corner++) {
        let offset = vec2(f32(corner & 1), f32(corner >> 1)) * 2.0 - 1.0;
        sum += textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy + offset * texel, depth);
    }
    return sum * 0.25;
}

// Irradiance of a surface, as weights: from the hemisphere, and from the sun if it is visible.
fn falling(world: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let facing_all = vec4(normal, 1.0);
    var light = max(vec3(0.0), vec3(
        dot(lighting.ambient_red, facing_all),
        dot(lighting.ambient_green, facing_all),
        dot(lighting.ambient_blue, facing_all),
    ));
    let facing = dot(normal, lighting.sun_direction.xyz);
    if (facing > 0.0) {
        var visible = 1.0;
        // The condition differs from pixel to pixel on purpose: for each value of a uniform one lavapipe compiles a
        // shader, and keeps it.
        if (SHADOWED && lighting.sun_direction.w * facing > 0.0) {
            visible = sunlit(world, normal);
        }
        light += lighting.sun.rgb * facing * visible;
    }
    return light;
}

@fragment
fn fragment(in: Fragment, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    var doppler = 1.0;
    if (DOPPLER || SEARCHLIGHT) {
        doppler = pixel_doppler(in.clip.xy);
    }
    return seen(in, front, doppler);
}

@fragment
fn fragment_animated(in: AnimatedFragment, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return seen(Fragment(in.clip, in.world, in.normal, in.uv, in.colour), front, exp2(in.log2_doppler));
}

// Level added to that of textures' smaller copies: a sample stands for a part of its pixel only.
fn texture_level() -> f32 {
    return log2(view.layer.y) + TEXTURE_BIAS;
}

// Base colour and opacity of a fragment.
fn base_colour(in: Fragment) -> vec4<f32> {
    let texel = textureSampleBias(base_colour_texture, base_colour_sampler, in.uv.xy, texture_level());
    return material.base_colour * in.colour * texel;
}

// Radiance, weights or position that a fragment shows; `doppler`: factor of its light.
fn seen(in: Fragment, front: bool, doppler: f32) -> vec4<f32> {
    let level = texture_level();
    let base = base_colour(in);
    var emitted = vec3(0.0);
    if (EMISSIVE) {
        emitted = material.emissive.rgb * textureSampleBias(emissive_texture, emissive_sampler, in.uv.zw, level).rgb;
    }
    // A shader that may discard is run for hidden fragments as well: only masked materials do.
    if (MASKED && base.a < material.emissive.w) {
        discard;
    }

    if (PLACES) {
        return vec4(in.world, 1.0 + view.layer.x);
    }

    // Weights that leave the surface: on its own carrier, and what it emits besides.
    var weights = base.rgb;
    if (SPECTRAL) {
        weights = vec3(dot(base.rgb, LUMINANCE));
    }
    if (LIT) {
        let normal = normalize(in.normal) * select(-1.0, 1.0, front);
        weights *= falling(in.world, normal);
    }
    weights *= material.carriers.z;
    emitted *= material.carriers.w;
    if (EMISSIVE && !SPLIT) {
        weights += emitted;
    }

    // The map keeps the weights of one carrier at a time.
    if (MAP) {
        var kept = select(vec3(0.0), weights, material.carriers.x == view.layer.x);
        if (SPLIT) {
            kept += select(vec3(0.0), emitted, material.carriers.y == view.layer.x);
        }
        return vec4(min(kept, vec3(LARGEST)), base.a);
    }

    var light = observed_light(weights, u32(material.carriers.x), doppler);
    if (SPLIT) {
        light += observed_light(emitted, u32(material.carriers.y), doppler);
    }
    if (BLENDED) {
        light.a = base.a;
    }
    return light;
}
