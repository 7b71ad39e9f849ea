// From the map of the world around the eye to what the observer sees: a pixel's direction, bent, finds its pane, and the pane its light.

struct Cut {
    at: vec2<f32>,
    padding: vec2<f32>,
    parts: vec4<i32>,
}

struct Pane {
    corner: vec2<f32>,
    scale: vec2<f32>,
    low: vec2<f32>,
    high: vec2<f32>,
}

struct Map {
    cube_from_observer: mat4x4<f32>,
    first_roots: vec4<i32>,
    last_roots: vec4<i32>,
}

// How many carriers the map has, and whether texels are mixed or the nearest one is taken.
override LAYERS: u32 = 1u;
override SMOOTH: bool = true;

@group(1) @binding(0) var<uniform> map: Map;
@group(1) @binding(1) var<storage, read> cuts: array<Cut>;
@group(1) @binding(2) var<storage, read> panes: array<Pane>;
@group(1) @binding(3) var atlas: texture_2d_array<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

// The cube's face that a direction meets: where its tree begins.
fn root(direction: vec3<f32>) -> i32 {
    let size = abs(direction);
    if (size.z >= size.x && size.z >= size.y) {
        return select(map.first_roots.y, map.first_roots.x, direction.z >= 0.0);
    }
    if (size.x >= size.y) {
        return select(map.first_roots.w, map.first_roots.z, direction.x >= 0.0);
    }
    return select(map.last_roots.y, map.last_roots.x, direction.y >= 0.0);
}

// Where on that face, in tangents from its middle, right and up for one who looks at it from within.
fn tangents(direction: vec3<f32>) -> vec2<f32> {
    let size = abs(direction);
    if (size.z >= size.x && size.z >= size.y) {
        return select(direction.xy, direction.yx, direction.z >= 0.0) / size.z;
    }
    if (size.x >= size.y) {
        return select(direction.yz, direction.zy, direction.x >= 0.0) / size.x;
    }
    return select(direction.zx, direction.xz, direction.y >= 0.0) / size.y;
}

// Weights of one carrier at a place in the atlas, within a pane.
fn weights_at(place: vec2<f32>, pane: Pane, layer: u32) -> vec3<f32> {
    if (!SMOOTH) {
        let texel = clamp(floor(place), pane.low, pane.high - 1.0);
        return textureLoad(atlas, vec2<i32>(texel), layer, 0).rgb;
    }
    // Panes are drawn one texel beyond their edges, so that there is always a neighbour.
    let middle = clamp(place, pane.low, pane.high) - 0.5;
    let corner = floor(middle);
    let share = middle - corner;
    let texel = vec2<i32>(corner);
    let below = mix(
        textureLoad(atlas, texel, layer, 0).rgb,
        textureLoad(atlas, texel + vec2(1, 0), layer, 0).rgb,
        share.x,
    );
    let above = mix(
        textureLoad(atlas, texel + vec2(0, 1), layer, 0).rgb,
        textureLoad(atlas, texel + vec2(1, 1), layer, 0).rgb,
        share.x,
    );
    return mix(below, above, share.y);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    // In the cube's axes the motion is along z: a boost changes z alone, and x and y keep every digit beside the stern.
    let observed = normalize((map.cube_from_observer * vec4(pixel_direction(at.xy), 0.0)).xyz);
    let seen = world_from_observer(observed, vec4(0.0, 0.0, 1.0, view.motion.w));

    var node = root(seen.direction);
    let tangent = tangents(seen.direction);
    while (node >= 0) {
        let cut = cuts[node];
        let right = select(0u, 1u, tangent.x >= cut.at.x);
        let above = select(0u, 2u, tangent.y >= cut.at.y);
        node = cut.parts[right + above];
    }
    let pane = panes[-1 - node];
    let place = pane.low + pane.scale * (tangent - pane.corner);

    var light = vec4(0.0);
    for (var layer = 0u; layer < LAYERS; layer++) {
        light += observed_light(weights_at(place, pane, layer), layer, seen.doppler);
    }
    return light;
}
