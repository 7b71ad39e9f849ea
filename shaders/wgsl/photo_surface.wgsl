// The photo-surface of a vertex: the f32 twin of physics::light_cone.

// Apparent position of a vertex relative to the eye, observer's axes; `world`: its position relative to the scene's
// origin. Within 14.5 degrees of dead astern the part across the motion loses its digits.
fn apparent_position(world: vec3<f32>) -> vec3<f32> {
    let e = view.motion.xyz;
    let kappa = view.motion.w;
    let displacement = (world - view.eye.xyz) - view.eye_rest.xyz;
    let along = dot(displacement, e);
    let across = displacement - along * e;
    let across_squared = dot(across, across);
    let distance = sqrt(along * along + across_squared);

    // Neither r + |h| nor its quotient cancels.
    let big = distance + abs(along);
    let small = across_squared / max(big, 1e-37);
    let advanced = 0.5 * kappa * select(big, small, along < 0.0);
    let retarded = 0.5 / kappa * select(small, big, along < 0.0);
    return across + (advanced - retarded) * e;
}
