//! Text of a datagram: its lines, the blocks in brackets, the time of the measurement.

use thiserror::Error;

/// Usual port of DTrack.
pub const PORT: u16 = 5000;
/// Length of the longest datagram that is accepted, bytes: about a hundred bodies.
pub const LONGEST_DATAGRAM: usize = 32 * 1024;

/// Reason for skipping a datagram, or a line of it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DtrackError {
    /// A datagram that is too long.
    #[error("a datagram of more than {LONGEST_DATAGRAM} bytes")]
    TooLong,
    /// Bytes outside ASCII.
    #[error("a datagram that is not ASCII text; does something else send to this port?")]
    NotText,
    /// A line that cannot be read.
    #[error("a `{line}` line: expected {expected}")]
    Line {
        /// Name of the line.
        line: &'static str,
        /// Description of a correct line.
        expected: &'static str,
    },
    /// A matrix that is no rotation.
    #[error("{thing} {number}: its matrix is no rotation")]
    Matrix {
        /// Kind of the body.
        thing: &'static str,
        /// Number of the body.
        number: i32,
    },
}

/// Time at which a frame was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct DtrackStamp {
    pub(super) measured_s: Option<f64>,
    pub(super) latency_s: Option<f64>,
}

/// Text of a datagram.
pub(super) fn text(bytes: &[u8]) -> Result<&str, DtrackError> {
    if bytes.len() > LONGEST_DATAGRAM {
        return Err(DtrackError::TooLong);
    }
    std::str::from_utf8(bytes).ok().filter(|text| text.is_ascii()).ok_or(DtrackError::NotText)
}

/// Rest of each line that begins with this name.
pub(super) fn lines<'a>(text: &'a str, name: &'static str) -> impl Iterator<Item = &'a str> {
    text.split(['\r', '\n']).filter_map(move |line| line.strip_prefix(name)?.strip_prefix(' '))
}

/// Time of the measurement; it may stand behind the bodies.
pub(super) fn stamp(text: &str) -> Result<DtrackStamp, DtrackError> {
    let bad = |line, expected| DtrackError::Line { line, expected };
    if let Some(line) = lines(text, "ts2").next() {
        let mut fields = line.split_ascii_whitespace().map(str::parse::<u32>);
        let (Some(Ok(seconds)), Some(Ok(microseconds)), Some(Ok(latency))) =
            (fields.next(), fields.next(), fields.next())
        else {
            return Err(bad("ts2", "seconds, microseconds, microseconds of latency"));
        };
        let measured_s = f64::from(seconds) + 1e-6 * f64::from(microseconds);
        return Ok(DtrackStamp { measured_s: Some(measured_s), latency_s: Some(1e-6 * f64::from(latency)) });
    }
    let Some(line) = lines(text, "ts").next() else {
        return Ok(DtrackStamp::default());
    };
    let seconds = line.trim().parse().ok().filter(|seconds: &f64| seconds.is_finite());
    let seconds = seconds.ok_or(bad("ts", "seconds since midnight"))?;
    Ok(DtrackStamp { measured_s: Some(seconds), latency_s: None })
}

/// First field of a line or block, which must be a number, and the rest.
pub(super) fn count(line: &str) -> Option<(usize, &str)> {
    let line = line.trim_start();
    let (count, rest) = line.split_once([' ', '[']).map_or((line, ""), |(count, _)| (count, &line[count.len()..]));
    Some((count.parse().ok()?, rest))
}

/// Text between the next pair of brackets, which must come at once.
pub(super) fn block<'a>(rest: &mut &'a str) -> Option<&'a str> {
    let (block, behind) = rest.trim_start().strip_prefix('[')?.split_once(']')?;
    *rest = behind;
    Some(block.trim())
}

/// Exactly `N` finite numbers.
pub(super) fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    let mut fields = text.split_ascii_whitespace();
    for number in &mut numbers {
        *number = finite(fields.next()?)?;
    }
    fields.next().is_none().then_some(numbers)
}

/// Finite number.
pub(super) fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}
