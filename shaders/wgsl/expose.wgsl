// Exposure and white, from the histogram of the gain.

var<workgroup> below: array<u32, THREADS>;
var<workgroup> samples: u32;
var<workgroup> bright: f32;

// Finds the trimmed mean, and the value that all but the brightest samples keep below.
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
        if (from_below < rank && rank <= end) {
            bright = means[own];
        }
        from_below = end;
    }
    workgroupBarrier();
    // Sum the gains. A value far darker than the brightest could not be shown beside it: it counts as that dark and no
    // darker.
    from_below = below[thread];
    for (var own = 0u; own < OWN; own++) {
        let end = from_below + counts[own];
        let kept = max(min(end, samples - trimmed), trimmed) - min(max(from_below, trimmed), samples - trimmed);
        sums[thread] += f32(kept) * max(means[own], bright - METER_REACH);
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
        adaptation.log2_exposure = metering.log2_exposure - adaptation.gain;
        let stops = adaptation.log2_exposure - metering.log2_scale;
        adaptation.exposure = exp2(clamp(stops, -LARGEST_LOG2, LARGEST_LOG2));
    }
    adaptation.white = exp2(max(0.0, adaptation.bright + adaptation.log2_exposure));
}
