// Draws what is behind everything: each pixel's direction is taken from the observer's axes to the world's, and the
// sky or the panorama is looked up there.

// True if weights for the map are drawn instead of the light that an observer sees.
override MAP: bool = false;
// True if places of surfaces are drawn; here is none.
override PLACES: bool = false;
// True if a picture, or one colour, is shown instead of sky, haze and sun.
override PANORAMA: bool = false;
override BACKGROUND: bool = false;

@group(0) @binding(5) var panorama: texture_2d<f32>;
@group(0) @binding(6) var panorama_sampler: sampler;

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

// A gradient from the horizon up, haze below, and the glow around the sun.
fn sky(direction: vec3<f32>) -> vec3<f32> {
    let height = direction.y;
    let clear = mix(lighting.horizon.rgb, lighting.zenith.rgb, smoothstep(0.0, SKY_ZENITH_FROM, sqrt(max(height, 0.0))));
    let haze = mix(lighting.ground.rgb * SKY_HAZE, clear, smoothstep(-SKY_HAZE_DEPTH, 0.0, height));
    let towards_sun = max(dot(direction, lighting.sun_direction.xyz), 0.0);
    let glow = SKY_GLOW * pow(towards_sun, SKY_GLOW_POWER)
        + SKY_SUN * smoothstep(SKY_SUN_OUTER, SKY_SUN_INNER, towards_sun);
    return haze + glow * lighting.sun.rgb;
}

// Place of a world direction in an equirectangular picture, 0 to 1; its middle is -z.
fn place_in_panorama(direction: vec3<f32>) -> vec2<f32> {
    let longitude = atan2(direction.x, -direction.z);
    let latitude = atan2(direction.y, length(direction.xz));
    return vec2(0.5 + longitude / TURN, 0.5 - 2.0 * latitude / TURN);
}

// The mean of the panorama over the footprint of a pixel: `right` and `down` are the directions of its neighbours.
//
// Aberration stretches footprints without bound (W 5.5.4): several looks along the longer side, each filtered over the
// shorter one.
fn surrounding(middle: vec3<f32>, right: vec3<f32>, down: vec3<f32>) -> vec3<f32> {
    let size = vec2<f32>(textureDimensions(panorama));
    let across = right - middle;
    let along = down - middle;
    let shorter = min(dot(across, across), dot(along, along));
    let longer = max(dot(across, across), dot(along, along));
    let axis = select(along, across, dot(across, across) > dot(along, along));
    let looks = clamp(ceil(sqrt(longer / max(shorter, 1e-20))), 1.0, PANORAMA_LOOKS);
    // Mip level by texels of the picture per radian, at its equator.
    let level = log2(max(max(sqrt(shorter), sqrt(longer) / looks) * size.x / TURN, 1.0));
    var sum = vec3(0.0);
    for (var look = 0.0; look < looks; look += 1.0) {
        let direction = normalize(middle + axis * ((look + 0.5) / looks - 0.5));
        sum += textureSampleLevel(panorama, panorama_sampler, place_in_panorama(direction), level).rgb;
    }
    return sum / looks;
}

@fragment
fn fragment(in: Pixel) -> @location(0) vec4<f32> {
    if (PLACES) {
        return vec4(0.0);
    }
    let observed = normalize(view.forward.xyz + in.place.x * view.right.xyz + in.place.y * view.up.xyz);
    let seen = world_from_observer(observed, view.motion);
    var weights = lighting.background.rgb;
    var carrier = 0.0;
    if (!BACKGROUND) {
        if (PANORAMA) {
            // The directions of the neighbouring samples, at unit distance along the view's middle.
            let step_right = view.layer.y * view.shift.z * view.right.xyz;
            let step_down = -view.layer.y * view.shift.w * view.up.xyz;
            let middle = view.forward.xyz + in.place.x * view.right.xyz + in.place.y * view.up.xyz;
            let right = world_from_observer(normalize(middle + step_right), view.motion).direction;
            let down = world_from_observer(normalize(middle + step_down), view.motion).direction;
            weights = surrounding(seen.direction, right, down);
        } else {
            weights = lighting.horizon.w * sky(seen.direction);
            carrier = lighting.zenith.w;
        }
    }
    if (MAP) {
        return vec4(select(vec3(0.0), min(weights, vec3(LARGEST)), carrier == view.layer.x), 1.0);
    }
    var doppler = 1.0;
    if (DOPPLER || SEARCHLIGHT) {
        doppler = seen.doppler;
        if (!GEOMETRY) {
            doppler = doppler_of_world(observed, vec4(view.motion.xyz, view.shift.x));
        }
    }
    return observed_light(weights, u32(carrier), doppler);
}
