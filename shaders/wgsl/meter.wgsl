// The light meter: histograms of a frame, and what the eye makes of them. Integers only are shared between threads, so that the sums do not
// depend on the order in which threads come by.

struct Metering {
    exposure: f32,
    log2_exposure: f32,
    log2_scale: f32,
    share: f32,
    automatic: u32,
    gains: u32,
    luminances: u32,
}

// A bin of a histogram of base-2 logarithms. `rest` sums how far its samples lie above its lower edge, in 65536ths of its width.
struct Bin {
    count: atomic<u32>,
    rest: atomic<u32>,
}

const THREADS: u32 = 256u;
const OWN: u32 = METER_BINS / THREADS;

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> metering: Metering;
// First the bins of the gain, then those of the luminance.
@group(0) @binding(2) var<storage, read_write> bins: array<Bin>;
@group(0) @binding(3) var<storage, read_write> adaptation: Adaptation;
@group(0) @binding(4) var<storage, read_write> curve: array<f32>;

fn count(first: u32, log2_value: f32) {
    let position = clamp((log2_value + METER_OCTAVES) * METER_BINS_PER_OCTAVE, 0.0, f32(METER_BINS) - 0.01);
    let bin = u32(position);
    atomicAdd(&bins[first + bin].count, 1u);
    atomicAdd(&bins[first + bin].rest, u32(65536.0 * fract(position)));
}

// Counts the pixels of a grid over the frame.
@compute @workgroup_size(METER_WORKGROUP, METER_WORKGROUP)
fn survey(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(radiance);
    let grid = min(size, METER_GRID);
    if (any(id.xy >= grid)) {
        return;
    }
    let texel = sound(textureLoad(radiance, (2u * id.xy + 1u) * size / (2u * grid), 0));
    let seen = luminance(texel.rgb);
    if (seen < DARKEST) {
        return;
    }
    let log2_seen = log2(seen) - metering.log2_scale;
    if (metering.gains == 1u && texel.a >= DARKEST) {
        count(0u, log2_seen - log2(texel.a));
    }
    if (metering.luminances == 1u) {
        count(METER_BINS, log2_seen);
    }
}

var<workgroup> below: array<u32, THREADS>;
var<workgroup> sums: array<f32, THREADS>;
var<workgroup> samples: u32;
var<workgroup> bright: f32;

// Gain: the trimmed mean, and the value that all but the brightest samples keep below.
@compute @workgroup_size(THREADS)
fn expose(@builtin(local_invocation_index) thread: u32) {
    // Take the thread's bins, leaving them empty for the next frame, and number the samples from the darkest up.
    var counts: array<u32, OWN>;
    var means: array<f32, OWN>;
    for (var own = 0u; own < OWN; own++) {
        let bin = thread * OWN + own;
        counts[own] = atomicExchange(&bins[bin].count, 0u);
        let rest = f32(atomicExchange(&bins[bin].rest, 0u)) / 65536.0;
        means[own] = (f32(bin) + rest / f32(max(counts[own], 1u))) / METER_BINS_PER_OCTAVE - METER_OCTAVES;
        below[thread] += counts[own];
    }
    workgroupBarrier();
    if (thread == 0u) {
        for (var other = 0u; other < THREADS; other++) {
            let here = below[other];
            below[other] = samples;
            samples += here;
        }
    }
    workgroupBarrier();

    let trimmed = samples * METER_TRIM_PERCENT / 100u;
    let rank = (samples * METER_BRIGHT_PERCENT + 99u) / 100u;
    var from_below = below[thread];
    for (var own = 0u; own < OWN; own++) {
        let end = from_below + counts[own];
        let kept = max(min(end, samples - trimmed), trimmed) - min(max(from_below, trimmed), samples - trimmed);
        sums[thread] += f32(kept) * means[own];
        if (from_below < rank && rank <= end) {
            bright = means[own];
        }
        from_below = end;
    }
    workgroupBarrier();
    if (thread != 0u) {
        return;
    }

    // Adapt, by a share of the way.
    if (samples > 0u) {
        var sum = 0.0;
        for (var other = 0u; other < THREADS; other++) {
            sum += sums[other];
        }
        let mean = sum / f32(samples - 2u * trimmed);
        adaptation.gain = adaptation.gain * (1.0 - metering.share) + mean * metering.share;
        adaptation.bright = adaptation.bright * (1.0 - metering.share) + bright * metering.share;
    }
    adaptation.log2_exposure = metering.log2_exposure;
    adaptation.exposure = metering.exposure;
    if (metering.automatic == 1u) {
        adaptation.log2_exposure = -adaptation.gain;
        adaptation.exposure = exp2(clamp(-adaptation.gain - metering.log2_scale, -LARGEST_LOG2, LARGEST_LOG2));
    }
    adaptation.white = exp2(max(0.0, adaptation.bright + adaptation.log2_exposure));
}

var<workgroup> totals: array<atomic<u32>, HISTOGRAM_PASSES>;
var<workgroup> left: atomic<u32>;
var<workgroup> darkest_bin: atomic<u32>;

// Luminance: histogram adjustment with a linear ceiling (Larson, Rushmeier, Piatko 1997, 4.4).
@compute @workgroup_size(THREADS)
fn equalise(@builtin(local_invocation_index) thread: u32) {
    // Counts become 16.16 fixed-point numbers, so that a ceiling may be a fraction of a sample.
    var counts: array<u32, OWN>;
    if (thread == 0u) {
        atomicStore(&darkest_bin, METER_BINS);
    }
    workgroupBarrier();
    for (var own = 0u; own < OWN; own++) {
        let bin = thread * OWN + own;
        counts[own] = atomicExchange(&bins[METER_BINS + bin].count, 0u) << 16u;
        atomicStore(&bins[METER_BINS + bin].rest, 0u);
        if (counts[own] > 0u) {
            atomicMin(&darkest_bin, bin);
        }
    }

    // Cut the bins off where the curve would be steeper than the linear one; each cut lowers the ceiling.
    for (var cut = 0u; cut < HISTOGRAM_PASSES; cut++) {
        var sum = 0u;
        for (var own = 0u; own < OWN; own++) {
            sum += counts[own];
        }
        atomicAdd(&totals[cut], sum);
        workgroupBarrier();
        let ceiling = u32(f32(atomicLoad(&totals[cut])) / (SCREEN_OCTAVES * METER_BINS_PER_OCTAVE));
        for (var own = 0u; own < OWN; own++) {
            counts[own] = min(counts[own], ceiling);
        }
    }
    for (var own = 0u; own < OWN; own++) {
        atomicAdd(&left, counts[own]);
    }
    workgroupBarrier();

    // Each bin's share of the screen's range; below the darkest sample the curve goes on linearly.
    let width = 1.0 / METER_BINS_PER_OCTAVE;
    let remaining = f32(atomicLoad(&left));
    let darkest = atomicLoad(&darkest_bin);
    var steps: array<f32, OWN>;
    for (var own = 0u; own < OWN; own++) {
        let share = f32(counts[own]) / max(remaining, 1.0);
        steps[own] = select(min(share * SCREEN_OCTAVES, width), width, thread * OWN + own < darkest);
        sums[thread] += steps[own];
    }
    workgroupBarrier();
    let all_samples = f32(atomicLoad(&totals[0]));
    if (all_samples == 0.0) {
        return;
    }

    // Sum from the brightest down. A frame whose range the screen has anyway is left linear.
    let linear = remaining < HISTOGRAM_TOLERANCE * all_samples;
    var value = 0.0;
    for (var other = THREADS - 1u; other > thread; other--) {
        value -= sums[other];
    }
    for (var own = OWN; own > 0u; own--) {
        let edge = thread * OWN + own;
        bend(edge, value, linear);
        value -= steps[own - 1u];
    }
    if (thread == 0u) {
        bend(0u, value, linear);
    }
}

// Moves one point of the curve by a share of the way.
fn bend(edge: u32, value: f32, linear: bool) {
    let identity = f32(edge) / METER_BINS_PER_OCTAVE - METER_OCTAVES + adaptation.log2_exposure;
    curve[edge] = curve[edge] * (1.0 - metering.share) + select(value, identity, linear) * metering.share;
}
