// Aberration of a direction, and its Doppler factor: the f32 twin of physics::aberration.

struct Aberrated {
    // Unit vector from the observer to where the light comes from.
    direction: vec3<f32>,
    // nu_observed / nu_emitted.
    doppler: f32,
}

// From the observer's axes to the world's (the inverse boost of an observer's direction).
//
// `motion`: unit vector along the celerity, and kappa = gamma + |u|. Light-cone form (tan(theta/2) = kappa tan(theta'/2)):
// a boost only scales the two light-cone coordinates 1 + cos(theta) and 1 - cos(theta), so nothing cancels.
fn world_from_observer(observed: vec3<f32>, motion: vec4<f32>) -> Aberrated {
    let along = dot(motion.xyz, observed);
    let across = observed - along * motion.xyz;
    let squared = dot(across, across);
    let length = sqrt(along * along + squared);
    let big = length + abs(along);
    let small = squared / big;
    let ahead = select(small, big, along >= 0.0) * 0.5 / motion.w;
    let behind = select(big, small, along >= 0.0) * 0.5 * motion.w;
    let scaled = across + (ahead - behind) * motion.xyz;
    return Aberrated(scaled / (ahead + behind), length / (ahead + behind));
}

// The Doppler factor of light from a world direction, D = gamma + u.n, for a picture that shows directions as the world has them.
fn doppler_of_world(direction: vec3<f32>, motion: vec4<f32>) -> f32 {
    let along = dot(motion.xyz, direction);
    let across = direction - along * motion.xyz;
    let squared = dot(across, across);
    let length = sqrt(along * along + squared);
    let big = length + abs(along);
    let small = squared / big;
    let ahead = select(small, big, along >= 0.0) * 0.5 * motion.w;
    let behind = select(big, small, along >= 0.0) * 0.5 / motion.w;
    return (ahead + behind) / length;
}
