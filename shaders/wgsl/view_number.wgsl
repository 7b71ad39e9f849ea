// The number of each view as its colour, so that a device can be asked whether it tells views apart.

@fragment
fn fragment(@builtin(view_index) view: u32) -> @location(0) vec4<f32> {
    return vec4(f32(view), 1.0 - f32(view), 0.0, 1.0);
}
