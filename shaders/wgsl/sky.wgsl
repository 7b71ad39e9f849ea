// Behind everything: each pixel's direction is taken from the observer's axes to the world's, and the sky looked up there.

struct Pixel {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Pixel {
    // One triangle that covers the picture, at depth zero: infinitely far.
    let place = vec2(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return Pixel(vec4(place, 0.0, 1.0), place);
}

@fragment
fn fragment(in: Pixel) -> @location(0) vec4<f32> {
    if (lighting.background.w == 1.0) {
        return vec4(lighting.background.rgb, 1.0);
    }
    let observed = view.forward.xyz + in.place.x * view.right.xyz + in.place.y * view.up.xyz;
    let direction = world_from_observer(normalize(observed), view.motion).direction;

    // A gradient from the horizon up, haze below, and the glow around the sun.
    let height = direction.y;
    let clear = mix(lighting.horizon.rgb, lighting.zenith.rgb, smoothstep(0.0, 0.9, sqrt(max(height, 0.0))));
    let haze = mix(lighting.ground.rgb * 2.0, clear, smoothstep(-0.25, 0.0, height));
    let towards_sun = max(dot(direction, lighting.sun_direction.xyz), 0.0);
    let glow = 0.25 * pow(towards_sun, 24.0) + 4.0 * smoothstep(0.99985, 0.99995, towards_sun);
    return vec4(haze + glow * lighting.sun.rgb, 1.0);
}
