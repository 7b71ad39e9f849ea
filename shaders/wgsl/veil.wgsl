// Darkens a channel's picture with the angle from straight ahead: by nothing up to one angle, by all of an opacity from
// another on, and smoothly between. The angle is that of the way from the eye through the pixel's point of the screen.

struct VeilUniforms {
    eye: vec4<f32>,
    ahead: vec4<f32>,
    screen_corner: vec4<f32>,
    screen_right: vec4<f32>,
    screen_up: vec4<f32>,
    viewport: vec4<f32>,
    shade: vec4<f32>,
}

// Power of the screen's signal that is what the target holds: 1 for the signal itself.
override SIGNAL_POWER: f32 = 1.0;

@group(0) @binding(0) var<uniform> veil: VeilUniforms;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let share = (at.xy - veil.viewport.xy) / veil.viewport.zw;
    let point = veil.screen_corner.xyz + share.x * veil.screen_right.xyz + (1.0 - share.y) * veil.screen_up.xyz;
    let direction = point - veil.eye.xyz;
    let angle = atan2(length(cross(veil.ahead.xyz, direction)), dot(veil.ahead.xyz, direction));
    let opacity = veil.shade.z * smoothstep(veil.shade.x, veil.shade.y, angle);
    return vec4(0.0, 0.0, 0.0, 1.0 - pow(1.0 - opacity, SIGNAL_POWER));
}
