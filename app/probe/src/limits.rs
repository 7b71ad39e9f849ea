//! Limits of one question.

/// Longest line that is read, bytes. A question of this length has some fifty thousand legs. A longer line is not a
/// question but other data on standard input, and must not fill the memory.
pub const LONGEST_LINE: usize = 4 << 20;

/// Largest number of steps of one `worldline` question, all legs together: seconds of computing.
pub const MOST_STEPS: f64 = 1e7;
