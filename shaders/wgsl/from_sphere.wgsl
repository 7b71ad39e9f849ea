// Takes a picture from light of all directions: each pixel's direction finds its place in the sphere, whose width is the
// whole turn and whose height the angle from above to below.

// Direction for each pixel, axes of the sphere; w = 0 where the picture shows nothing.
@group(0) @binding(0) var directions: texture_2d<f32>;
@group(0) @binding(1) var sphere: texture_2d<f32>;

fn light_at(place: vec2<i32>) -> vec4<f32> {
    let size = vec2<i32>(textureDimensions(sphere));
    // The left edge follows the right one.
    let column = (place.x % size.x + size.x) % size.x;
    return textureLoad(sphere, vec2(column, clamp(place.y, 0, size.y - 1)), 0);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let direction = textureLoad(directions, vec2<i32>(at.xy), 0);
    if (direction.w == 0.0) {
        return vec4(0.0);
    }
    let longitude = atan2(direction.x, -direction.z);
    let latitude = atan2(direction.y, length(direction.xz));
    let share = vec2(longitude / TURN + 0.5, 0.5 - 2.0 * latitude / TURN);
    let place = share * vec2<f32>(textureDimensions(sphere)) - 0.5;
    let first = vec2<i32>(floor(place));
    let within = place - floor(place);
    let above = mix(light_at(first), light_at(first + vec2(1, 0)), within.x);
    let below = mix(light_at(first + vec2(0, 1)), light_at(first + vec2(1, 1)), within.x);
    return mix(above, below, within.y);
}
