//! Law: the physics has no error above 1e-10, however extreme the speed, the angle, the distance or the step. A
//! program that uses the textbook's formulas unchanged has errors of radians straight behind, and one that sums its
//! clock without care drifts.
#![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

use measure::extremes::{Extent, ExtremesError, ExtremesRow, LIMIT, check, document, rows};

#[test]
fn nothing_is_worse_than_the_limit() {
    let rows = rows(Extent::QUICK).unwrap();
    for row in &rows {
        println!("{:e} {} {}", row.error, row.what, row.quantity);
    }
    check(&rows).unwrap();
    for part in ["straight behind", "at the eye", "1e15 m", "1e9 m", "resting", "coasting", "reversals", "circle"] {
        assert!(rows.iter().any(|row| row.what.contains(part)), "{part}");
    }
    let table = document(&rows);
    assert_eq!(table.lines().filter(|line| line.starts_with("| ")).count(), rows.len() + 1, "{table}");
}

#[test]
fn an_error_beyond_the_limit_is_told() {
    let row = |error| ExtremesRow { what: "it".into(), cases: 1, quantity: "way", error, limit: LIMIT };
    assert!(check(&[row(0.0), row(LIMIT)]).is_ok());
    for bad in [2.0 * LIMIT, f64::INFINITY, f64::NAN] {
        let told = check(&[row(0.0), row(bad)]).unwrap_err();
        assert!(matches!(&told, ExtremesError::Exceeded { count: 1, .. }), "{told}");
    }
}
