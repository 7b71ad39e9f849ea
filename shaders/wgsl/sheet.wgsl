// Draws a sheet that floats in a room over a channel's picture: each pixel's point on the screen, seen from the eye,
// finds its place on the sheet. It is at rest beside the eye, so nothing bends it.

struct SheetUniforms {
    eye: vec4<f32>,
    corner: vec4<f32>,
    right: vec4<f32>,
    up: vec4<f32>,
    screen_corner: vec4<f32>,
    screen_right: vec4<f32>,
    screen_up: vec4<f32>,
    viewport: vec4<f32>,
}

// True if each pixel's point on the screen is in a table, false if the screen is flat.
override TABLE: bool = false;
// True if each pixel is multiplied by a factor of its own, and a value is added to it.
override GAINS: bool = false;
// Power of its light that is the screen's signal; 0 for the sRGB curve.
override SIGNAL_POWER: f32 = 0.0;

@group(0) @binding(0) var<uniform> sheet: SheetUniforms;
// Picture on the sheet: sRGB, times its opacity.
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var mixed: sampler;
// Point of the screen for each pixel, room's axes, metres; w = 0 if the projector meets no surface.
@group(0) @binding(3) var points: texture_2d<f32>;
@group(0) @binding(4) var gains: texture_2d<f32>;

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    // Find the pixel's point on the screen.
    let share = (at.xy - sheet.viewport.xy) / sheet.viewport.zw;
    var point = vec4(sheet.screen_corner.xyz + share.x * sheet.screen_right.xyz
        + (1.0 - share.y) * sheet.screen_up.xyz, 1.0);
    if (TABLE) {
        point = textureLoad(points, vec2<i32>(share * vec2<f32>(textureDimensions(points))), 0);
    }

    // Meet the sheet on the way from the eye through it.
    let direction = point.xyz - sheet.eye.xyz;
    let normal = cross(sheet.right.xyz, sheet.up.xyz);
    let towards = dot(direction, normal);
    let way = dot(sheet.corner.xyz - sheet.eye.xyz, normal) / select(towards, 1e-9, abs(towards) < 1e-9);
    let met = sheet.eye.xyz + way * direction - sheet.corner.xyz;
    let place = vec2(dot(met, sheet.right.xyz) / dot(sheet.right.xyz, sheet.right.xyz),
        1.0 - dot(met, sheet.up.xyz) / dot(sheet.up.xyz, sheet.up.xyz));
    let across = dpdx(place);
    let down = dpdy(place);
    let pixel = max(vec2(length(vec2(across.x, down.x)), length(vec2(across.y, down.y))), vec2(1e-9));
    let inside = min(place, 1.0 - place) / pixel + 0.5;
    let cover = clamp(inside.x, 0.0, 1.0) * clamp(inside.y, 0.0, 1.0);
    if (point.w == 0.0 || way <= 0.0 || cover <= 0.0) {
        discard;
    }

    // Take the mean of two places of the pixel, each of which is filtered.
    let aside = 0.25 * (across + down);
    let sum = textureSampleLevel(picture, mixed, place - aside, 0.0)
        + textureSampleLevel(picture, mixed, place + aside, 0.0);
    let opacity = 0.5 * sum.a;
    let encoded = clamp(0.5 * sum.rgb / max(opacity, 1e-4), vec3(0.0), vec3(1.0));

    // Show it as the channel's own light is shown.
    if (ENCODE && SIGNAL_POWER == 0.0 && !GAINS) {
        return vec4(encoded, 1.0) * opacity * cover;
    }
    var linear = linear_of(encoded);
    if (GAINS) {
        let gain = mixed_at(gains, share);
        linear = clamp(linear * gain.r + gain.g, vec3(0.0), vec3(1.0));
    }
    var shown = linear;
    if (ENCODE && SIGNAL_POWER > 0.0) {
        shown = pow(linear, vec3(SIGNAL_POWER));
    } else if (ENCODE) {
        shown = srgb(linear);
    }
    return vec4(shown, 1.0) * opacity * cover;
}
