// The histogram's tone curve: histogram adjustment with a linear ceiling (Larson, Rushmeier, Piatko 1997, 4.4).

var<workgroup> totals: array<atomic<u32>, HISTOGRAM_PASSES>;
var<workgroup> left: atomic<u32>;
var<workgroup> darkest_bin: atomic<u32>;

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

    // Give each bin its share of the screen's range; below the darkest sample the curve goes on linearly.
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
