// Colour and brightness for the observer of light from the world: the f32 twin of physics::colour::ShiftTable.
//
// A radiance is three weights on a carrier spectrum. The table holds, over ln D, the colour of each weight alone with
// its wavelengths shifted: the ratios red/Y, green/Y, blue/Y, and log2 Y, which stays straight where Y itself spans
// all of f32.

// Effects that a pipeline shows; `IDENTITY`: at D = 1 the weights are the colour.
override GEOMETRY: bool = true;
override DOPPLER: bool = true;
override SEARCHLIGHT: bool = true;
override IDENTITY: bool = false;
// The largest value that the target holds.
override LARGEST: f32 = HALF_LIMIT;

@group(0) @binding(4) var shift_table: texture_2d<f32>;

// Linear sRGB relative to the white at rest, times the view's scale; and the luminance at rest, unscaled.
fn observed_light(weights: vec3<f32>, carrier: u32, doppler: f32) -> vec4<f32> {
    // Take the light at rest from the middle of the table.
    var at_rest = dot(weights, LUMINANCE);
    var colour = weights;
    if (!IDENTITY) {
        let first = shifted(weights, carrier, f32(SHIFT_NODES / 2u));
        colour = first.rgb;
        at_rest = first.a;
    }
    if (DOPPLER) {
        colour = shifted(weights, carrier, f32(SHIFT_NODES / 2u) + log2(doppler) * SHIFT_NODES_PER_OCTAVE).rgb;
    }
    if (SEARCHLIGHT) {
        // Multiply in logarithms: the fourth power of a large factor times a small scale must not pass through
        // infinity.
        colour *= exp2(min(4.0 * log2(doppler) + log2(view.shift.y), LARGEST_LOG2));
    } else {
        colour *= view.shift.y;
    }
    return vec4(clamp(colour, vec3(-LARGEST), vec3(LARGEST)), at_rest);
}

// Colour of weights at a place in the table, and its luminance. Beyond the table's ends the colour stays, and the
// luminance goes on as a power.
fn shifted(weights: vec3<f32>, carrier: u32, place: f32) -> vec4<f32> {
    let node = u32(clamp(place, 0.0, f32(SHIFT_NODES - 2u)));
    let fraction = place - f32(node);
    var sum = vec4(0.0);
    for (var weight = 0u; weight < 3u; weight++) {
        let row = carrier * 3u + weight;
        let left = textureLoad(shift_table, vec2(node, row), 0);
        let right = textureLoad(shift_table, vec2(node + 1u, row), 0);
        let ratios = mix(left.rgb, right.rgb, clamp(fraction, 0.0, 1.0));
        sum += weights[weight] * exp2(mix(left.a, right.a, fraction)) * vec4(ratios, 1.0);
    }
    return sum;
}

// The direction that a pixel sees along, in the axes of the picture's observer; not normalised.
fn pixel_direction(at: vec2<f32>) -> vec3<f32> {
    let place = vec2(at.x * view.shift.z - 1.0, 1.0 - at.y * view.shift.w);
    return view.forward.xyz + place.x * view.right.xyz + place.y * view.up.xyz;
}

// The Doppler factor of what a pixel sees.
fn pixel_doppler(at: vec2<f32>) -> f32 {
    let direction = normalize(pixel_direction(at));
    let motion = vec4(view.motion.xyz, view.shift.x);
    if (GEOMETRY) {
        return world_from_observer(direction, motion).doppler;
    }
    // Light of a moving object had another frequency in the world to begin with; for an object at rest this divides by
    // one.
    return doppler_of_world(direction, motion) / doppler_of_world(direction, view.source);
}
