//! Law: a bracketed root is found to the last bit, whatever Newton's own steps would do; and a search that finds none
//! says why. A wrong program would run out of the bracket on a flat stretch, go round in a cycle, or return its last
//! guess as if it were a root.

use std::convert::Infallible;

use physics::newton::{Newton, NewtonError, RootInterval};

/// A search to the last bit.
const EXACT: Newton = Newton { tolerance: 0.0, most_steps: 200 };

fn rising(low: f64, high: f64) -> RootInterval {
    RootInterval::Bracket { low, high, sign_at_low: -1.0 }
}

fn sure(value: f64, slope: f64) -> Result<(f64, f64), Infallible> {
    Ok((value, slope))
}

#[test]
fn square_root_of_two_is_found_to_the_last_bit_from_any_start() {
    for start in [1e-12, 0.1, 1.0, 1.4, 2.0] {
        let root = EXACT.root(rising(0.0, 2.0), start, |x| sure(x * x - 2.0, 2.0 * x)).unwrap();
        assert!((root - std::f64::consts::SQRT_2).abs() <= f64::EPSILON, "from {start}: {root}");
    }
}

#[test]
fn a_falling_function_is_solved_as_well_as_a_rising_one() {
    let interval = RootInterval::Bracket { low: 0.0, high: 9.0, sign_at_low: 3.0 };
    assert_eq!(EXACT.root(interval, 0.0, |x| sure(3.0 - x, -1.0)), Ok(3.0));
}

#[test]
fn cycles_of_newtons_steps_are_broken_by_bisection() {
    // sign(x) √|x|: the step from x leads to −x, for ever.
    let mut looks = 0;
    let root = EXACT.root(rising(-1.0, 3.0), 0.9, |x: f64| {
        looks += 1;
        sure(x.signum() * x.abs().sqrt(), 0.5 / x.abs().sqrt())
    });
    assert!(root.unwrap().abs() < 1e-15 && looks < 100, "{root:?} after {looks} looks");
}

#[test]
fn steps_that_are_not_numbers_are_replaced_by_bisection() {
    // A staircase has no slope at all.
    let root = EXACT.root(rising(0.0, 10.0), 1.0, |x: f64| sure(if x < 7.0 { -1.0 } else { 1.0 }, 0.0)).unwrap();
    assert!((root - 7.0).abs() < 1e-14, "{root}");
}

#[test]
fn a_tolerance_ends_the_search_early() {
    let mut looks = 0;
    let loose = Newton { tolerance: 1e-3, most_steps: 200 };
    let root = loose.root(rising(0.0, 2.0), 2.0, |x| {
        looks += 1;
        sure(x * x - 2.0, 2.0 * x)
    });
    assert!((root.unwrap() - std::f64::consts::SQRT_2).abs() < 1e-3 && looks <= 4, "{root:?} after {looks} looks");
}

#[test]
fn without_a_bracket_a_step_out_of_the_range_ends_the_search() {
    let range = RootInterval::Range { low: -1.0, high: 1.0 };
    // x² + 1 has no root; x² − x/4 has two within.
    let none = EXACT.root(range, 0.3, |x| sure(x * x + 1.0, 2.0 * x));
    assert!(matches!(none, Err(NewtonError::Left { low: -1.0, high: 1.0, .. })), "{none:?}");
    let flat = EXACT.root(range, 0.0, |x| sure(x * x + 1.0, 2.0 * x));
    assert!(matches!(flat, Err(NewtonError::Left { x: 0.0, .. })), "{flat:?}");
    assert_eq!(EXACT.root(range, 1.0, |x| sure(x * (x - 0.25), 2.0 * x - 0.25)), Ok(0.25));
    let tolerant = Newton { tolerance: 4.0 * f64::EPSILON, most_steps: 200 };
    let root = tolerant.root(range, 1.0, |x| sure(x * x * x - 0.3, 3.0 * x * x)).unwrap();
    assert!((root - 0.3_f64.cbrt()).abs() <= 4.0 * f64::EPSILON, "{root}");
}

#[test]
fn a_search_that_does_not_converge_says_so() {
    let hurried = Newton { tolerance: 0.0, most_steps: 3 };
    let late = hurried.root(rising(0.0, 2.0), 1e-6, |x| sure(x * x - 2.0, 2.0 * x));
    assert!(matches!(late, Err(NewtonError::NotConverged { steps: 3, .. })), "{late:?}");
}

#[test]
fn an_error_of_the_function_is_passed_on() {
    let error = EXACT.root(rising(0.0, 2.0), 1.0, |_| Err("no value here"));
    assert_eq!(error, Err(NewtonError::Function("no value here")));
}
