//! Numbers of pictures: ranges as render farms write them, and the part of them that falls to one of many programs.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;
use thiserror::Error;

/// Largest number of a picture.
const LARGEST: u64 = 99_999_999;

/// Numbers of the pictures of a film: ranges such as `1-100`, `3,5-10` or `7-20:2`, ends included.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNumbers(Vec<FrameRange>);

/// Numbers from the first to the last, in steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FrameRange {
    first: u64,
    last: u64,
    step: u64,
}

/// Text that gives no numbers of pictures.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum NumbersError {
    /// A part that is no range.
    #[error("expected numbers of pictures, as in 12, 1-100, 3,5-10 or 7-20:2, each up to {LARGEST}; \"{0}\" is none")]
    Range(String),
    /// A range that ends before it begins.
    #[error("{0} ends before it begins")]
    Backwards(String),
}

/// Share of one of several programs that make pictures together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FarmPart {
    /// Number of the program, from 0.
    pub index: u64,
    /// Number of programs, at least 1.
    pub count: u64,
}

/// Environment that does not say which part a program has.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PartError {
    /// No known variables.
    #[error(
        "--part env: none of SLURM_ARRAY_TASK_ID, SLURM_PROCID, OMPI_COMM_WORLD_RANK and PMI_RANK is set; name the \
         part, as in --part 3/16"
    )]
    Nothing,
    /// Variables that do not fit.
    #[error("--part env: {rank}={index} and {size}={count} do not name a part; name it, as in --part 3/16")]
    Wrong {
        /// Variable of the program's number.
        rank: &'static str,
        /// Its value.
        index: String,
        /// Variable of the number of programs.
        size: &'static str,
        /// Its value.
        count: String,
    },
}

impl FrameNumbers {
    /// Numbers from 0 up to `count`, without it.
    pub fn first(count: u64) -> Self {
        Self(count.checked_sub(1).map(|last| FrameRange { first: 0, last, step: 1 }).into_iter().collect())
    }

    /// The numbers, in the order in which they were written, without repetition.
    pub fn iter(&self) -> impl Iterator<Item = u64> + '_ {
        self.0.iter().enumerate().flat_map(|(index, range)| {
            let before = &self.0[..index];
            range.iter().filter(move |number| !before.iter().any(|range| range.has(*number)))
        })
    }

    /// Every `step`th of the numbers, beginning with the first, of which a part of a farm has its share: every one of
    /// `count` in turn.
    pub fn shared(&self, step: u64, part: FarmPart) -> impl Iterator<Item = u64> + '_ {
        let stride = usize::try_from(step.max(1).saturating_mul(part.count)).unwrap_or(usize::MAX);
        let skipped = usize::try_from(part.index.saturating_mul(step.max(1))).unwrap_or(usize::MAX);
        self.iter().skip(skipped).step_by(stride)
    }
}

impl FrameRange {
    fn iter(self) -> impl Iterator<Item = u64> {
        (self.first..=self.last).step_by(usize::try_from(self.step).unwrap_or(usize::MAX))
    }

    fn has(&self, number: u64) -> bool {
        (self.first..=self.last).contains(&number) && (number - self.first).is_multiple_of(self.step)
    }
}

impl FromStr for FrameNumbers {
    type Err = NumbersError;
    fn from_str(text: &str) -> Result<Self, NumbersError> {
        let range = |part: &str| {
            let wrong = || NumbersError::Range(part.to_owned());
            let number = |text: &str| text.trim().parse().ok().filter(|number| *number <= LARGEST).ok_or_else(wrong);
            let (ends, step) = part.split_once(':').unwrap_or((part, "1"));
            let (first, last) = ends.split_once("..").or_else(|| ends.split_once('-')).unwrap_or((ends, ends));
            let range = FrameRange { first: number(first)?, last: number(last)?, step: number(step)? };
            match range {
                FrameRange { step: 0, .. } => Err(wrong()),
                FrameRange { first, last, .. } if last < first => Err(NumbersError::Backwards(part.to_owned())),
                range => Ok(range),
            }
        };
        text.split(',').map(range).collect::<Result<_, _>>().map(Self)
    }
}

impl Display for FrameNumbers {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (index, FrameRange { first, last, step }) in self.0.iter().enumerate() {
            let comma = if index > 0 { "," } else { "" };
            write!(f, "{comma}{first}")?;
            if last > first {
                write!(f, "-{last}")?;
            }
            if *step > 1 {
                write!(f, ":{step}")?;
            }
        }
        Ok(())
    }
}

impl FarmPart {
    /// The whole.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Part `text` of the form 3/16, counted from 1.
    pub fn numbered(text: &str) -> Option<Self> {
        let (number, count) = text.split_once('/')?;
        let (number, count): (u64, u64) = (number.trim().parse().ok()?, count.trim().parse().ok()?);
        (1..=count).contains(&number).then(|| Self { index: number - 1, count })
    }

    /// Part that the environment of a batch system names: a Slurm array, a Slurm step, Open MPI, or a PMI launcher.
    /// `variable` gives the value of a variable of the environment.
    ///
    /// # Errors
    /// [`PartError`] if it names none.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Result<Self, PartError> {
        // Variables of the number and the count, and of the first number where that is not 0.
        const KNOWN: [(&str, &str, Option<&str>); 4] = [
            ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", Some("SLURM_ARRAY_TASK_MIN")),
            ("SLURM_PROCID", "SLURM_NTASKS", None),
            ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", None),
            ("PMI_RANK", "PMI_SIZE", None),
        ];
        let known = KNOWN.into_iter().find_map(|names| Some((names, variable(names.0)?)));
        let ((rank, size, least), index) = known.ok_or(PartError::Nothing)?;
        let count = variable(size).unwrap_or_default();
        let least = least.and_then(&variable).and_then(|text| text.parse().ok()).unwrap_or(0);
        let part = index.parse::<u64>().ok().and_then(|index| index.checked_sub(least)).zip(count.parse().ok());
        part.map(|(index, count)| Self { index, count })
            .filter(|part| part.index < part.count)
            .ok_or(PartError::Wrong { rank, index, size, count })
    }
}

#[cfg(test)]
mod tests {
    //! Law: the parts of a farm together make every picture once, whatever the engine calls them. A wrong program
    //! leaves holes in a film.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;
    use std::collections::BTreeMap;

    fn numbers(text: &str) -> Vec<u64> {
        text.parse::<FrameNumbers>().unwrap().iter().collect()
    }

    #[test]
    fn ranges_are_read_as_farms_write_them() {
        assert_eq!(numbers("1-4"), [1, 2, 3, 4]);
        assert_eq!(numbers("2..4"), [2, 3, 4]);
        assert_eq!(numbers("3,5-7"), [3, 5, 6, 7]);
        assert_eq!(numbers("7-20:6"), [7, 13, 19]);
        assert_eq!(numbers("0"), [0]);
        assert_eq!(numbers("1-5,3-8:2,2"), [1, 2, 3, 4, 5, 7]);
        for text in ["1-100", "3,5-10", "7-20:2", "4"] {
            assert_eq!(text.parse::<FrameNumbers>().unwrap().to_string(), text);
        }
        assert_eq!(FrameNumbers::first(3).iter().collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(FrameNumbers::first(0).iter().count(), 0);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for text in ["", "a", "1-", "-5", "1-2-3", "1:0", "1,,2", "1.5", "100000000", "1-3:x"] {
            assert!(matches!(text.parse::<FrameNumbers>(), Err(NumbersError::Range(_))), "{text}");
        }
        assert_eq!("9-3".parse::<FrameNumbers>(), Err(NumbersError::Backwards("9-3".to_owned())));
    }

    #[test]
    fn parts_together_make_every_picture_once() {
        let all: FrameNumbers = "3,5-40,60-90:3".parse().unwrap();
        for step in [1, 3] {
            let wanted: Vec<u64> = all.iter().step_by(step).collect();
            for count in [1, 2, 7, 100] {
                let part = |index| all.shared(step as u64, FarmPart { index, count }).collect::<Vec<_>>();
                let mut made: Vec<u64> = (0..count).flat_map(part).collect();
                made.sort_unstable();
                assert_eq!(made, wanted, "{count} parts in steps of {step}");
            }
        }
    }

    #[test]
    fn the_environment_names_the_part() {
        let part = |variables: &[(&str, &str)]| {
            let variables: BTreeMap<_, _> = variables.iter().copied().collect();
            FarmPart::of_environment(|name| variables.get(name).map(|value| (*value).to_owned()))
        };
        let expected = Ok(FarmPart { index: 2, count: 4 });
        let array = [("SLURM_ARRAY_TASK_ID", "3"), ("SLURM_ARRAY_TASK_COUNT", "4"), ("SLURM_ARRAY_TASK_MIN", "1")];
        assert_eq!(part(&array), expected);
        assert_eq!(part(&[("SLURM_PROCID", "2"), ("SLURM_NTASKS", "4")]), expected);
        assert_eq!(part(&[("OMPI_COMM_WORLD_RANK", "2"), ("OMPI_COMM_WORLD_SIZE", "4")]), expected);
        assert_eq!(part(&[("PMI_RANK", "2"), ("PMI_SIZE", "4")]), expected);
        assert_eq!(part(&[]), Err(PartError::Nothing));
        assert!(matches!(part(&[("PMI_RANK", "4"), ("PMI_SIZE", "4")]), Err(PartError::Wrong { .. })));
        assert!(matches!(part(&[("PMI_RANK", "0")]), Err(PartError::Wrong { .. })));
        assert_eq!(FarmPart::numbered("3/4"), Some(FarmPart { index: 2, count: 4 }));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0"] {
            assert_eq!(FarmPart::numbered(wrong), None, "{wrong}");
        }
    }
}
