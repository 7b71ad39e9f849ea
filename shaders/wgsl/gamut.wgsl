// Brings colours that the screen has no light for to colours that it has (W 3.2.5, fig. 3.5). The others pass as they
// are.

// The colour moved towards the grey of its luminance, as little as suffices.
fn desaturated(rgb: vec3<f32>) -> vec3<f32> {
    let grey = clamp(luminance(rgb), 0.0, 1.0);
    let colour = rgb - grey;
    let room = select(vec3(1.0 - grey), vec3(grey), colour < vec3(0.0));
    let shares = room / max(max(abs(colour), room), vec3(DARKEST));
    return clamp(grey + min(min(shares.r, shares.g), shares.b) * colour, vec3(0.0), vec3(1.0));
}

// The colour with white added until nothing is negative, then darkened until nothing is above one.
fn whitened(rgb: vec3<f32>) -> vec3<f32> {
    let lifted = rgb - min(0.0, min(min(rgb.r, rgb.g), rgb.b));
    return lifted / max(1.0, max(max(lifted.r, lifted.g), lifted.b));
}

fn in_gamut(rgb: vec3<f32>) -> vec3<f32> {
    if (GAMUT == GAMUT_OPEN) {
        return rgb;
    }
    let clamped = clamp(rgb, vec3(0.0), vec3(1.0));
    if (all(clamped == rgb)) {
        return rgb;
    }
    switch GAMUT {
        case GAMUT_DESATURATE: { return desaturated(rgb); }
        case GAMUT_WHITE: { return whitened(rgb); }
        default: { return clamped; }
    }
}
