// Aberration of a direction, and its Doppler factor: the f32 twin of physics::aberration.
//
// Light-cone form (tan(theta/2) = kappa tan(theta'/2)): a boost only scales the two light-cone coordinates 1 +
// cos(theta) and 1 - cos(theta), so nothing cancels. See physics::light_cone.

struct Aberrated {
    // Unit vector from the observer to where the light comes from.
    direction: vec3<f32>,
    // Doppler factor, nu_observed / nu_emitted.
    doppler: f32,
}

// A direction of any length, split along a motion.
struct Split {
    // Part of the direction across the motion.
    across: vec3<f32>,
    length: f32,
    // Half the light-cone coordinates, times the length: half of length + along, half of length - along.
    ahead: f32,
    behind: f32,
}

fn split(direction: vec3<f32>, motion: vec3<f32>) -> Split {
    let along = dot(motion, direction);
    let across = direction - along * motion;
    let squared = dot(across, across);
    let length = sqrt(along * along + squared);
    let big = length + abs(along);
    let small = squared / big;
    let towards = along >= 0.0;
    return Split(across, length, 0.5 * select(small, big, towards), 0.5 * select(big, small, towards));
}

// A direction of the observer's axes, taken to the world's (the inverse boost).
//
// `motion`: unit vector along the celerity, and kappa = gamma + |u|.
fn world_from_observer(observed: vec3<f32>, motion: vec4<f32>) -> Aberrated {
    let parts = split(observed, motion.xyz);
    let ahead = parts.ahead / motion.w;
    let behind = parts.behind * motion.w;
    let scaled = parts.across + (ahead - behind) * motion.xyz;
    return Aberrated(scaled / (ahead + behind), parts.length / (ahead + behind));
}

// The Doppler factor of light from a world direction, D = gamma + u.n, for a picture that shows directions as the
// world has them.
fn doppler_of_world(direction: vec3<f32>, motion: vec4<f32>) -> f32 {
    let parts = split(direction, motion.xyz);
    return (parts.ahead * motion.w + parts.behind / motion.w) / parts.length;
}
