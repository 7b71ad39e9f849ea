// Inputs of every drawing shader. Mirrors of shaders/src/layout.rs.

struct ViewUniforms {
    clip_from_observer: mat4x4<f32>,
    forward: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    motion: vec4<f32>,
    shift: vec4<f32>,
    layer: vec4<f32>,
    source: vec4<f32>,
    eye: vec4<f32>,
    eye_rest: vec4<f32>,
}

struct LightingUniforms {
    shadow_from_world: mat4x4<f32>,
    sun_direction: vec4<f32>,
    sun: vec4<f32>,
    ambient_red: vec4<f32>,
    ambient_green: vec4<f32>,
    ambient_blue: vec4<f32>,
    ground: vec4<f32>,
    zenith: vec4<f32>,
    horizon: vec4<f32>,
    background: vec4<f32>,
}

@group(0) @binding(0) var<uniform> view: ViewUniforms;
@group(0) @binding(1) var<uniform> lighting: LightingUniforms;
