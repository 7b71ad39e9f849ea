//! The operations that the equations need of a vector register, and their portable implementation.
//!
//! Every operation rounds once, as IEEE 754 says, and there is no approximate reciprocal: so all widths that fuse
//! a·b + c agree to the bit. The portable form fuses if the target always can, and otherwise rounds twice, since a
//! fused operation in software costs a hundred times as much.

use std::mem::MaybeUninit;
use std::ops::{Add, Div, Mul, Sub};

use super::line::LINE;

/// A line of the caller's memory, written and never read.
pub(super) type OutputLine = [MaybeUninit<f32>; LINE];

/// A line of the caller's memory that is aligned to a cache line, so that it can be written past the caches.
#[repr(align(64))]
pub(super) struct AlignedLine(pub(super) OutputLine);

/// A register of f32 values, one a vertex.
pub(super) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Register of as many f64 values.
    type Wide: WideLanes;
    /// Number of values in the register; divides [`LINE`].
    const COUNT: usize;
    /// A set bit for every value.
    const ALL: u32 = u32::MAX >> (u32::BITS as usize - Self::COUNT);

    fn splat(value: f32) -> Self;
    /// Reads [`Lanes::COUNT`] values, from the first of `source`.
    fn load(source: &[f32]) -> Self;
    /// Writes [`Lanes::COUNT`] values, from the first of `target`.
    fn store(self, target: &mut [MaybeUninit<f32>]);
    /// Writes past the caches, from value `first` of the line, a multiple of [`Lanes::COUNT`].
    fn stream(self, target: &mut AlignedLine, first: usize);
    /// Makes all streamed values visible to other threads that are told of them next.
    fn finish_streaming();

    /// self · factor + term, rounded once if the target fuses.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// term − self · factor.
    fn negated_mul_add(self, factor: Self, term: Self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    /// The larger of self and `least`; `least` if self is not a number.
    fn or_at_least(self, least: Self) -> Self;
    /// A bit for every value below `limit`; none for a value that is not a number.
    fn below(self, limit: Self) -> u32;
    /// `negative` where self is below zero, else `other`.
    fn if_negative(self, negative: Self, other: Self) -> Self;
    /// `other` where the bit is set.
    fn replaced(self, bits: u32, other: Self) -> Self;

    fn widen(self) -> Self::Wide;
    fn narrow(wide: Self::Wide) -> Self;
}

/// Work that is written once for registers of every width.
pub(super) trait LaneWork {
    /// Result of the work.
    type Output;

    /// Does the work with registers of the type `L`.
    ///
    /// Implementations are `#[inline(always)]`, so that they are compiled with the instructions that the caller has
    /// enabled.
    fn run<L: Lanes>(self) -> Self::Output;
}

/// A register of as many f64 values as [`Lanes`] has f32 values.
pub(super) trait WideLanes: Copy + Sub<Output = Self> + Mul<Output = Self> {
    fn splat(value: f64) -> Self;
    /// self · factor − term.
    fn mul_sub(self, factor: Self, term: Self) -> Self;
}

/// An operation on each coordinate. No function can do this: a function that is handed over is compiled on its own
/// first, without the instructions that its caller has enabled, and registers then travel through memory.
macro_rules! each {
    ($operation:expr, $coordinates:expr) => {{
        let [x, y, z] = $coordinates;
        [$operation(x), $operation(y), $operation(z)]
    }};
}
pub(super) use each;

/// True if a fused multiply-add is an instruction on every processor that this build runs on.
const FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

/// Number of values in the portable register: what SSE2 and NEON hold.
const PORTABLE: usize = 4;

/// [`Lanes`] as an array, left to the compiler.
#[derive(Clone, Copy)]
pub(super) struct Portable<T>([T; PORTABLE]);

impl<T: Copy> Portable<T> {
    #[inline(always)]
    fn map<U>(self, f: impl Fn(T) -> U) -> Portable<U> {
        Portable(self.0.map(f))
    }

    #[inline(always)]
    fn zip<U>(self, other: Self, f: impl Fn(T, T) -> U) -> Portable<U> {
        Portable(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }

    #[inline(always)]
    fn bits(self, f: impl Fn(T) -> bool) -> u32 {
        self.0.iter().rev().fold(0, |bits, &value| bits << 1 | u32::from(f(value)))
    }
}

macro_rules! operator {
    ($($operator:ident::$method:ident),*) => {$(
        impl<T: Copy + $operator<Output = T>> $operator for Portable<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, $operator::$method)
            }
        }
    )*};
}

operator!(Add::add, Sub::sub, Mul::mul, Div::div);

impl Lanes for Portable<f32> {
    type Wide = Portable<f64>;
    const COUNT: usize = PORTABLE;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; PORTABLE])
    }

    #[inline(always)]
    fn load(source: &[f32]) -> Self {
        Self(std::array::from_fn(|lane| source[lane]))
    }

    #[inline(always)]
    fn store(self, target: &mut [MaybeUninit<f32>]) {
        for (target, value) in target[..PORTABLE].iter_mut().zip(self.0) {
            target.write(value);
        }
    }

    #[inline(always)]
    fn stream(self, target: &mut AlignedLine, first: usize) {
        self.store(&mut target.0[first..]);
    }

    #[inline(always)]
    fn finish_streaming() {}

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        if FUSED {
            Self(std::array::from_fn(|lane| self.0[lane].mul_add(factor.0[lane], term.0[lane])))
        } else {
            self * factor + term
        }
    }

    #[inline(always)]
    fn negated_mul_add(self, factor: Self, term: Self) -> Self {
        self.map(|value| -value).mul_add(factor, term)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f32::sqrt)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f32::abs)
    }

    #[inline(always)]
    fn or_at_least(self, least: Self) -> Self {
        self.zip(least, |value, least| if value > least { value } else { least })
    }

    #[inline(always)]
    fn below(self, limit: Self) -> u32 {
        self.zip(limit, |value, limit| value < limit).bits(|below| below)
    }

    #[inline(always)]
    fn if_negative(self, negative: Self, other: Self) -> Self {
        Self(std::array::from_fn(|lane| if self.0[lane] < 0.0 { negative.0[lane] } else { other.0[lane] }))
    }

    #[inline(always)]
    fn replaced(self, bits: u32, other: Self) -> Self {
        Self(std::array::from_fn(|lane| if bits >> lane & 1 == 1 { other.0[lane] } else { self.0[lane] }))
    }

    #[inline(always)]
    fn widen(self) -> Self::Wide {
        self.map(f64::from)
    }

    #[inline(always)]
    fn narrow(wide: Self::Wide) -> Self {
        wide.map(|value| value as f32)
    }
}

impl WideLanes for Portable<f64> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; PORTABLE])
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        if FUSED {
            Self(std::array::from_fn(|lane| self.0[lane].mul_add(factor.0[lane], -term.0[lane])))
        } else {
            self * factor - term
        }
    }
}
