// The scene as the sun sees it. Sun and scene are at rest in the world, so one map serves every observer.

@vertex
fn vertex(@location(3) world: vec3<f32>) -> @builtin(position) vec4<f32> {
    let place = lighting.shadow_from_world * vec4(world, 1.0);
    // Turn texture coordinates (y down) back into clip coordinates (y up).
    return vec4(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, place.z, 1.0);
}
