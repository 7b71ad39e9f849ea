// Combines both eyes' pictures on the same pixels: by turns, or by colours.

override COMBINE: u32 = COMBINE_ROWS;
override SWAP_EYES: bool = false;

@group(0) @binding(0) var first: texture_2d<f32>;
@group(0) @binding(1) var second: texture_2d<f32>;
@group(0) @binding(2) var<uniform> placement: PlacementUniforms;

// Share of each eye in the screen's red, green and blue: E. Dubois, "A projection method to generate anaglyph stereo
// images", ICASSP 2001.
fn dubois(left: vec3<f32>, right: vec3<f32>) -> vec3<f32> {
    return vec3(
        dot(DUBOIS_LEFT_RED, left) + dot(DUBOIS_RIGHT_RED, right),
        dot(DUBOIS_LEFT_GREEN, left) + dot(DUBOIS_RIGHT_GREEN, right),
        dot(DUBOIS_LEFT_BLUE, left) + dot(DUBOIS_RIGHT_BLUE, right),
    );
}

// `placement.odd` is 1 if the window's first row lies on an odd row of the monitor, plus 2 for its first column.
fn is_odd(at: vec2<f32>) -> vec2<bool> {
    let monitor = vec2<u32>(at) + vec2(u32(placement.odd) >> 1u, u32(placement.odd) & 1u);
    return (monitor & vec2(1u)) == vec2(1u);
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let texel = vec2<i32>(at.xy - placement.origin);
    let one = textureLoad(first, texel, 0).rgb;
    let other = textureLoad(second, texel, 0).rgb;
    let left = select(one, other, SWAP_EYES);
    let right = select(other, one, SWAP_EYES);
    let odd = is_odd(at.xy);
    var shown = vec3(0.0);
    switch COMBINE {
        case COMBINE_ROWS: { shown = select(left, right, odd.y); }
        case COMBINE_COLUMNS: { shown = select(left, right, odd.x); }
        case COMBINE_CHECKER: { shown = select(left, right, odd.x != odd.y); }
        case COMBINE_DUBOIS: { shown = clamp(dubois(left, right), vec3(0.0), vec3(1.0)); }
        case COMBINE_GREY: { shown = vec3(dot(LUMINANCE, left), vec2(dot(LUMINANCE, right))); }
        default: { shown = vec3(dot(LUMINANCE, left), right.gb); }
    }
    if (ENCODE) {
        shown = srgb(shown);
    }
    return vec4(shown, 1.0);
}
