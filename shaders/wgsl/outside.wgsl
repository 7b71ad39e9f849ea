// The photo-surface seen from outside (W 5.1.5): the camera is not at the eye. The Doppler factor of a point is that of
// its direction from the eye, whatever the camera looks at.
//
// In these pictures view.source.xyz is the camera's place relative to the eye, in the axes of the pure boost of the
// scene's part; view.layer.z is the width of a ring of equal delay, metres, and view.layer.w the largest log2 D of the
// motion. Between corners everything follows from the place in the scene, which is interpolated exactly.

// Value that colours show, OUTSIDE_LIGHT and others.
override COLOURING: u32 = 0u;

struct OutsideFragment {
    @invariant @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec4<f32>,
    @location(3) colour: vec4<f32>,
    // Apparent position relative to the eye, observer's axes, if the body is animated.
    @location(4) apparent: vec3<f32>,
    @location(5) log2_doppler: f32,
}

fn outside(seen: vec3<f32>, in: Vertex, log2_doppler: f32) -> OutsideFragment {
    let clip = view.clip_from_observer * vec4(seen, 1.0);
    return OutsideFragment(clip, in.world, in.normal, vec4(in.uv, in.emissive_uv), in.colour, seen, log2_doppler);
}

@vertex
fn vertex_outside(at: ApparentPosition, in: Vertex) -> OutsideFragment {
    var seen = vec3(at.x, at.y, at.z);
    if (BENDS) {
        seen = select(apparent_position(in.world), seen, at.x < NOT_BENT);
    }
    return outside(seen, in, 0.0);
}

@vertex
fn vertex_outside_animated(at: ApparentPosition, in: Vertex, @location(7) log2_doppler: f32) -> OutsideFragment {
    return outside(vec3(at.x, at.y, at.z), in, log2_doppler);
}

// Normal of the photo-surface where a surface with this normal is seen, `displacement` from the eye: the twin of
// physics::apparent_shape::normal, not normalised.
fn outside_normal(normal: vec3<f32>, displacement: vec3<f32>, doppler: f32) -> vec3<f32> {
    let e = view.motion.xyz;
    let w = 0.5 * (view.motion.w - 1.0 / view.motion.w);
    let facing = dot(normal, e);
    let across = (displacement - e * dot(displacement, e)) / length(displacement);
    let along = facing / doppler;
    return normal - e * facing - across * (w * along) + e * along;
}

// Blue for light that is shifted up, red for light that is shifted down, white between; a dark line at every octave.
fn doppler_colour(log2_doppler: f32, line: f32) -> vec3<f32> {
    let share = clamp(log2_doppler / view.layer.w, -1.0, 1.0);
    let end = select(vec3(0.75, 0.04, 0.02), vec3(0.02, 0.1, 0.8), share > 0.0);
    return mix(vec3(0.85), end, sqrt(abs(share))) * (1.0 - 0.7 * line);
}

// Rings of equal delay: pale near the eye, deep blue far from it.
fn delay_colour(rings: f32, blurred: f32) -> vec3<f32> {
    let colour = mix(vec3(1.0, 0.7, 0.15), vec3(0.05, 0.12, 0.6), rings / (rings + 8.0));
    let place = abs(fract(0.5 * rings) - 0.5) * 4.0 - 1.0;
    let dark = clamp(0.5 - place / max(4.0 * blurred, 1e-6), 0.0, 1.0);
    return colour * mix(1.0, 0.35, mix(dark, 0.5, clamp(2.0 * blurred - 0.5, 0.0, 1.0)));
}

@fragment
fn fragment_outside(in: OutsideFragment, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let displacement = (in.world - view.eye.xyz) - view.eye_rest.xyz;
    var apparent = in.apparent;
    var doppler = exp2(in.log2_doppler);
    if (!ANIMATED) {
        apparent = apparent_position(in.world);
        doppler = doppler_of_world(displacement, view.motion);
    }
    let distance = length(apparent);
    // Differences between neighbouring pixels, before any may be discarded.
    let right = dpdx(apparent);
    let down = dpdy(apparent);
    let octave_width = fwidth(log2(doppler));
    let ring_width = fwidth(distance) / view.layer.z;
    let surface = Fragment(in.clip, in.world, in.normal, in.uv, in.colour);
    if (COLOURING == OUTSIDE_LIGHT) {
        return seen(surface, front, doppler);
    }
    let base = base_colour(surface);
    if (MASKED && base.a < material.emissive.w) {
        discard;
    }
    // A lamp at the camera shows the shape. Keys turn animated bodies, so their neighbours tell how they stand.
    var normal = cross(right, down);
    if (!ANIMATED) {
        normal = outside_normal(in.normal, displacement, doppler);
    }
    let lamp = normalize(view.source.xyz - apparent);
    let facing = abs(dot(normal, lamp)) / max(length(normal), 1e-30);
    var colour = vec3(0.0);
    if (COLOURING == OUTSIDE_DOPPLER) {
        let octaves = log2(doppler);
        let off = abs(octaves - round(octaves));
        colour = doppler_colour(octaves, 1.0 - smoothstep(0.5 * octave_width, 1.5 * octave_width, off));
    } else {
        colour = delay_colour(distance / view.layer.z, ring_width);
    }
    colour *= 0.25 + 0.75 * facing;
    return vec4(colour * view.shift.y, select(dot(colour, LUMINANCE), base.a, BLENDED));
}
