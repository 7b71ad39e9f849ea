// Draws what the observer sees from the map of the world around the eye: a pixel's direction, aberrated, finds its
// tile, and the tile its light.

struct AtlasTile {
    corner: vec2<f32>,
    scale: vec2<f32>,
    low: vec2<f32>,
    high: vec2<f32>,
}

struct MapUniforms {
    cube_from_observer: mat4x4<f32>,
}

// Number of carriers of the map; true if texels are mixed, false if the nearest one is taken.
override LAYERS: u32 = 1u;
override SMOOTH: bool = true;
// True if the map holds places of surfaces instead of weights.
override PLACES: bool = false;

@group(1) @binding(0) var<uniform> map: MapUniforms;
// Index of the tile for each cell: one layer for each quarter of a face, and one for each cell that is cut further.
@group(1) @binding(1) var cells: texture_2d_array<i32>;
// Tiles, two texels each: corner and scale, low and high.
@group(1) @binding(2) var panes: texture_2d<f32>;
@group(1) @binding(3) var atlas: texture_2d_array<f32>;
@group(1) @binding(4) var atlas_sampler: sampler;
// Reversed depth of the map; used only if something is drawn over the picture.
@group(1) @binding(5) var depths: texture_depth_2d;

// Point of a surface that is not flat for each pixel, room's axes, metres; w = 0 where nothing is lit.
@group(2) @binding(0) var points: texture_2d<f32>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(vec2(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

struct OnCube {
    face: u32,
    // Tangents from the face's middle, right and up as seen from within.
    tangent: vec2<f32>,
}

// Place at which a direction meets the cube. Faces: +z, -z, +x, -x, +y, -y.
fn on_cube(direction: vec3<f32>) -> OnCube {
    let size = abs(direction);
    if (size.z >= size.x && size.z >= size.y) {
        let ahead = direction.z >= 0.0;
        return OnCube(select(1u, 0u, ahead), select(direction.xy, direction.yx, ahead) / size.z);
    }
    if (size.x >= size.y) {
        let beside = direction.x >= 0.0;
        return OnCube(select(3u, 2u, beside), select(direction.yz, direction.zy, beside) / size.x);
    }
    let above = direction.y >= 0.0;
    return OnCube(select(5u, 4u, above), select(direction.zx, direction.xz, above) / size.y);
}

// The tile that holds a place on the cube. Each quarter of a face is counted from its middle outwards, so that nothing
// is added to a place beside the motion's axis, and no digit lost.
fn pane_at(place: OnCube) -> AtlasTile {
    let side = f32(MAP_CELLS);
    let quarter = select(0u, 1u, place.tangent.x < 0.0) + select(0u, 2u, place.tangent.y < 0.0);
    var within = min(abs(place.tangent) * side, vec2(side));
    var found = i32(4u * place.face + quarter);
    while (found >= 0) {
        let cell = min(floor(within), vec2(side - 1.0));
        found = textureLoad(cells, vec2<i32>(cell), found, 0).x;
        within = (within - cell) * side;
    }
    let first = textureLoad(panes, vec2(0, -1 - found), 0);
    let last = textureLoad(panes, vec2(1, -1 - found), 0);
    return AtlasTile(first.xy, first.zw, last.xy, last.zw);
}

fn nearest_texel(place: vec2<f32>, pane: AtlasTile) -> vec2<i32> {
    return vec2<i32>(clamp(floor(place), pane.low, pane.high - 1.0));
}

// Weights of one carrier at a place in the atlas, within a tile.
fn weights_at(place: vec2<f32>, pane: AtlasTile, layer: u32) -> vec3<f32> {
    if (!SMOOTH) {
        return textureLoad(atlas, nearest_texel(place, pane), layer, 0).rgb;
    }
    // Tiles are drawn one texel beyond their edges, so that there is always a neighbour.
    let within = clamp(place, pane.low, pane.high) / vec2<f32>(textureDimensions(atlas));
    return textureSampleLevel(atlas, atlas_sampler, within, layer, 0.0).rgb;
}

// Place at which a pixel looks into the map.
struct Look {
    pane: AtlasTile,
    // Place in the atlas, texels.
    place: vec2<f32>,
    doppler: f32,
    // Length of the pixel's direction, the picture's middle being one away, and length of that on the cube.
    observed_length: f32,
    cube_length: f32,
}

// Look along a direction of the observer's axes.
fn look(direction: vec3<f32>) -> Look {
    // The motion is along z in the cube's axes: a boost changes z alone, and x and y keep every digit beside the
    // stern.
    let observed = (map.cube_from_observer * vec4(direction, 0.0)).xyz;
    let seen = world_from_observer(observed, vec4(0.0, 0.0, 1.0, view.motion.w));

    let on_cube = on_cube(seen.direction);
    let pane = pane_at(on_cube);
    let place = pane.low + pane.scale * (on_cube.tangent - pane.corner);
    return Look(pane, place, seen.doppler, length(direction), length(vec3(on_cube.tangent, 1.0)));
}

fn shown(look: Look) -> vec4<f32> {
    if (PLACES) {
        return textureLoad(atlas, nearest_texel(look.place, look.pane), 0, 0);
    }
    var light = vec4(0.0);
    for (var layer = 0u; layer < LAYERS; layer++) {
        light += observed_light(weights_at(look.place, look.pane, layer), layer, look.doppler);
    }
    return light;
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    return shown(look(pixel_direction(at.xy)));
}

// Point of the surface beside a pixel's own, for a step of at most a pixel; the pixel's own where nothing is lit there.
fn point_beside(place: vec2<i32>, step: vec2<i32>, own: vec4<f32>) -> vec4<f32> {
    let point = textureLoad(points, clamp(place + step, vec2(0), vec2<i32>(textureDimensions(points)) - 1), 0);
    return select(own, point, point.w > 0.0);
}

// Draws the picture on a surface that is not flat. The view holds the room's axes instead of the picture's, as the
// observer has them: x right, y up, z forward; and in `eye` the eye's place in the room, in `eye_rest` the place of the
// sample beside the middle of its pixel, right and down, pixels.
@fragment
fn fragment_on_surface(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let place = vec2<i32>(at.xy);
    let own = textureLoad(points, place, 0);
    let offset = view.eye_rest.xy;
    let right = point_beside(place, vec2(select(-1, 1, offset.x > 0.0), 0), own) - own;
    let down = point_beside(place, vec2(0, select(-1, 1, offset.y > 0.0)), own) - own;
    let seen = (own + abs(offset.x) * right + abs(offset.y) * down).xyz - view.eye.xyz;
    // Where nothing is lit, look at anything.
    let lit = own.w > 0.0 && dot(seen, seen) > 0.0;
    let along = select(vec3(0.0, 0.0, 1.0), seen, lit);
    let light = shown(look(along.x * view.right.xyz + along.y * view.up.xyz + along.z * view.forward.xyz));
    return select(vec4(0.0), light, lit);
}

struct Shown {
    @location(0) light: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

// Draws the picture with the depth that a photo-surface would have there. At a distance r the map's depth is near / (r
// / cube_length), and the picture's (near / kappa) / (r D / observed_length), since r D is the apparent distance;
// where nothing is, both are zero.
@fragment
fn fragment_with_depth(@builtin(position) at: vec4<f32>) -> Shown {
    let look = look(pixel_direction(at.xy));
    let stretch = look.observed_length / (look.cube_length * view.motion.w * look.doppler);
    return Shown(shown(look), textureLoad(depths, nearest_texel(look.place, look.pane), 0) * stretch);
}
