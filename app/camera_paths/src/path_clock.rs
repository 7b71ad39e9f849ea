//! Clock along a path: the integral of its rate over a parameter, and the parameter at a reading.
//!
//! A parameter may be the world's time and the clock the camera's own, dτ/dt = √(1 − β²), or the other way round, dt/dτ
//! = √(1 + u²). The way is cut until Gauss's rule of ten points over a piece and over its halves agree to rounding; a
//! reading is then one sum in its piece, and the inverse is Newton's iteration there, held between the piece's ends.

/// Places and weights of Gauss and Legendre's rule of ten points on −1 to 1, the positive half (Abramowitz & Stegun,
/// table 25.4).
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// Difference of a piece from its halves at which it is fine enough, as a share of it.
const FINE: f64 = 1e-13;
/// Halvings of one interval at most: pieces below a millionth of it decide nothing.
const MOST_HALVINGS: u32 = 20;
/// Steps of an inverse that double precision takes, even by halving alone.
const MOST_STEPS: usize = 80;

/// Clock along a path.
#[derive(Clone, Debug)]
pub(crate) struct PathClock {
    /// Parameters at the ends of the pieces, ascending.
    parameters: Vec<f64>,
    /// Readings there, from 0.
    readings: Vec<f64>,
}

impl PathClock {
    /// Clock whose rate is smooth between neighbouring `knots`, of which there are two at least.
    pub(crate) fn new(knots: &[f64], rate: &dyn Fn(f64) -> f64) -> Self {
        let mut clock = Self { parameters: knots.first().copied().into_iter().collect(), readings: vec![0.0] };
        for ends in knots.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            clock.refine([from, to], integral([from, to], rate), MOST_HALVINGS, rate);
        }
        clock
    }

    fn refine(&mut self, [from, to]: [f64; 2], whole: f64, halvings: u32, rate: &dyn Fn(f64) -> f64) {
        let middle = 0.5 * (from + to);
        let [first, second] = [integral([from, middle], rate), integral([middle, to], rate)];
        if halvings == 0 || (first + second - whole).abs() <= FINE * whole.abs() {
            let reading = self.end() + (first + second);
            self.parameters.push(to);
            self.readings.push(reading);
        } else {
            self.refine([from, middle], first, halvings - 1, rate);
            self.refine([middle, to], second, halvings - 1, rate);
        }
    }

    /// Reading at the last knot.
    pub(crate) fn end(&self) -> f64 {
        self.readings.last().copied().unwrap_or(0.0)
    }

    /// Reading at a parameter.
    pub(crate) fn reading(&self, parameter: f64, rate: &dyn Fn(f64) -> f64) -> f64 {
        let piece = self.piece(&self.parameters, parameter);
        self.readings[piece] + integral([self.parameters[piece], parameter], rate)
    }

    /// Parameter at a reading; readings beyond the ends are those of the ends.
    pub(crate) fn parameter(&self, reading: f64, rate: &dyn Fn(f64) -> f64) -> f64 {
        let piece = self.piece(&self.readings, reading);
        let [begin, end] = [self.parameters[piece], self.parameters[piece + 1]];
        let [first, last] = [self.readings[piece], self.readings[piece + 1]];
        if reading <= first {
            return begin;
        }
        if reading >= last {
            return end;
        }
        let (mut low, mut high) = (begin, end);
        let mut parameter = begin + (end - begin) * ((reading - first) / (last - first));
        for _ in 0..MOST_STEPS {
            let late = first + integral([begin, parameter], rate) - reading;
            if late > 0.0 {
                high = parameter;
            } else {
                low = parameter;
            }
            let newton = parameter - late / rate(parameter);
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let step = (next - parameter).abs();
            parameter = next;
            if step <= f64::EPSILON * (begin.abs() + end.abs()) || late == 0.0 {
                break;
            }
        }
        parameter
    }

    /// Piece in which a value lies, the values being those at the pieces' ends.
    fn piece(&self, ends: &[f64], value: f64) -> usize {
        ends.partition_point(|end| *end <= value).saturating_sub(1).min(ends.len().saturating_sub(2))
    }
}

/// Gauss's sum over an interval.
fn integral([from, to]: [f64; 2], rate: &dyn Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let pair = |(place, weight): (f64, f64)| weight * (rate(middle - half * place) + rate(middle + half * place));
    half * GAUSS.into_iter().map(pair).sum::<f64>()
}

#[cfg(test)]
mod tests {
    //! Law: reading and parameter are inverse to each other and agree with integrals that are known in closed form,
    //! even where the rate touches zero. A coarse sum is off by more than rounding there.
    use super::*;

    #[test]
    fn a_known_integral_is_met_and_inverted() {
        // ∫ √(1 − sin² t) from 0: sin t, up to π/2, where the rate is zero.
        let rate = |t: f64| libm::cos(t);
        let end = std::f64::consts::FRAC_PI_2;
        let clock = PathClock::new(&[0.0, 0.4, end], &rate);
        assert!((clock.end() - 1.0).abs() < 1e-14, "{}", clock.end());
        for step in 0..=1000 {
            let t = end * f64::from(step) / 1000.0;
            let reading = clock.reading(t, &rate);
            assert!((reading - libm::sin(t)).abs() < 1e-14, "{reading} at {t}");
            let back = clock.parameter(reading, &rate);
            // At the end a reading says little about the time.
            assert!((libm::sin(back) - reading).abs() < 3e-15, "{back} for {t}");
        }
        assert_eq!([clock.parameter(-1.0, &rate), clock.parameter(2.0, &rate)], [0.0, end]);
    }

    #[test]
    fn a_kink_is_found_by_halving() {
        let rate = |t: f64| (t * t - 0.3).abs().sqrt();
        let clock = PathClock::new(&[0.0, 2.0], &rate);
        let back = clock.parameter(clock.reading(0.77, &rate), &rate);
        assert!((back - 0.77).abs() < 1e-12, "{back}");
        assert!(clock.readings.len() < 500, "{} pieces", clock.readings.len());
    }
}
