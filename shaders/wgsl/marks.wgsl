// Marks over an outside view: triangles whose corners the CPU has put into the picture.

struct Mark {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec4<f32>,
}

@vertex
fn vertex(@location(0) clip: vec4<f32>, @location(1) colour: vec4<f32>) -> Mark {
    return Mark(clip, colour);
}

@fragment
fn fragment(in: Mark) -> @location(0) vec4<f32> {
    return in.colour;
}
