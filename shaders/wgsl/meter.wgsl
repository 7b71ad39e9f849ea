// The light meter: histograms of a frame, and the adaptation that follows from them. Only integers are shared between
// threads, so that the sums do not depend on the order in which threads arrive.

struct MeteringUniforms {
    exposure: f32,
    log2_exposure: f32,
    log2_scale: f32,
    share: f32,
    automatic: u32,
    gains: u32,
    luminances: u32,
    columns: u32,
    rows: u32,
}

// A bin of a histogram of base-2 logarithms. `rest` sums how far its samples lie above its lower edge, in 65536ths of
// its width.
struct Bin {
    count: atomic<u32>,
    rest: atomic<u32>,
}

const THREADS: u32 = 256u;
const OWN: u32 = METER_BINS / THREADS;

// A sum over each thread's own bins.
var<workgroup> sums: array<f32, THREADS>;

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> metering: MeteringUniforms;
// Bins of the gain, then those of the luminance.
@group(0) @binding(2) var<storage, read_write> bins: array<Bin>;
@group(0) @binding(3) var<storage, read_write> adaptation: AdaptationState;
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
    let grid = min(size, vec2(metering.columns, metering.rows));
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
