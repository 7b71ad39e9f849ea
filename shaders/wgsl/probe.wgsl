// Runs the shared functions on given input, so that a test can hold them against their Rust twins.

@group(0) @binding(0) var<storage, read> motion: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> observed: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> result: array<vec4<f32>>;

@compute @workgroup_size(64)
fn aberration(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < arrayLength(&result)) {
        let aberrated = world_from_observer(observed[id.x].xyz, motion[id.x]);
        result[id.x] = vec4(aberrated.direction, aberrated.doppler);
    }
}

@compute @workgroup_size(64)
fn doppler(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < arrayLength(&result)) {
        result[id.x] = vec4(doppler_of_world(observed[id.x].xyz, motion[id.x]));
    }
}
