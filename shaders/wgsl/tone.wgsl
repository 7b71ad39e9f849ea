// Tone curves T(L). Each function returns T(L) / L for a luminance above zero, since a colour is scaled as a whole.

// Value of the histogram's curve in base-2 logarithms: from scene luminance to the screen's.
fn equalised(log2_scene: f32) -> f32 {
    let position = clamp((log2_scene + METER_OCTAVES) * METER_BINS_PER_OCTAVE, 0.0, f32(METER_BINS));
    let bin = min(u32(position), METER_BINS - 1u);
    return mix(curve[bin], curve[bin + 1u], position - f32(bin));
}

// (1 + L / w^2) / (1 + L): Reinhard et al. 2002, eq. 4. The identity where nothing is brighter than white.
fn reinhard(luminance: f32, white: f32) -> f32 {
    return select((1.0 + luminance / white / white) / (1.0 + luminance), 1.0, white == 1.0);
}

// (1 - e^-L) / L: B eq. 5.1; for small L by its series, since the difference cancels.
fn exponential(luminance: f32) -> f32 {
    let series = 1.0 - luminance * (0.5 - luminance / 6.0);
    return select((1.0 - exp(-luminance)) / luminance, series, luminance < 0.01);
}

// Narkowicz 2016: a fit to the Academy's film-like curve.
fn filmic(luminance: f32) -> f32 {
    return (FILMIC_A * luminance + FILMIC_B) / (luminance * (FILMIC_C * luminance + FILMIC_D) + FILMIC_E);
}

fn toned(rgb: vec3<f32>) -> vec3<f32> {
    let luminance = luminance(rgb);
    if (luminance <= 0.0) {
        return rgb;
    }
    switch TONE {
        case TONE_REINHARD: { return rgb * reinhard(luminance, adaptation.white); }
        case TONE_EXPONENTIAL: { return rgb * exponential(luminance); }
        case TONE_FILMIC: { return rgb * filmic(luminance); }
        case TONE_HISTOGRAM: {
            let exposed = log2(luminance);
            return rgb * exp2(equalised(exposed - adaptation.log2_exposure) - exposed);
        }
        default: { return rgb; }
    }
}
