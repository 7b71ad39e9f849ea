// Draws a room seen from anywhere: its screens with their pictures; screens seen from behind are outlines.

struct RoomViewUniforms {
    clip_from_room: mat4x4<f32>,
}

// True if only lines are drawn: those of a grid on the ground, and of a head.
override LINES: bool = false;

@group(0) @binding(0) var<uniform> room: RoomViewUniforms;
@group(0) @binding(1) var shown: texture_2d<f32>;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) edge: f32,
}

// `place`: position in the channel's picture, x right and y down; for lines, their brightness. `edge`: 0 at the
// picture's edge, else 1.
@vertex
fn vertex(@location(0) point: vec3<f32>, @location(1) place: vec2<f32>, @location(2) edge: f32) -> Corner {
    return Corner(room.clip_from_room * vec4(point, 1.0), place, edge);
}

@fragment
fn fragment(in: Corner, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    if (LINES) {
        return vec4(vec3(in.place.x), 1.0);
    }
    let from_edge = min(in.place, 1.0 - in.place) / max(fwidth(in.place), vec2(1e-6));
    let outline = (1.0 - in.edge) * (1.0 - smoothstep(0.5, 1.5, min(from_edge.x, from_edge.y)));
    let size = vec2<f32>(textureDimensions(shown));
    let at = in.place * size - 0.5;
    let near = vec2<i32>(floor(at));
    let share = at - floor(at);
    let last = vec2<i32>(size) - 1;
    var light = vec3(0.0);
    for (var corner = 0; corner < 4; corner++) {
        let offset = vec2(corner & 1, corner >> 1u);
        let weights = select(1.0 - share, share, offset == vec2(1));
        light += weights.x * weights.y * textureLoad(shown, clamp(near + offset, vec2(0), last), 0).rgb;
    }
    let lines = vec3(0.12) * outline;
    return vec4(select(lines, light + lines, front), 1.0);
}
