//! Two registers that work as one.
//!
//! The equations are a chain of some 130 cycles from load to store, square root and division included, and a processor
//! looks ahead no further than the next vector or two. Two registers taken through the chain side by side give it
//! something to do while it waits.

use std::mem::MaybeUninit;
use std::ops::{Add, Div, Mul, Sub};

use super::lanes::{AlignedLine, Lanes, WideLanes};

/// Two registers that go through every operation together.
#[derive(Clone, Copy)]
pub(super) struct Paired<L>(L, L);

macro_rules! operator {
    ($($operator:ident::$method:ident),*) => {$(
        impl<L: $operator<Output = L>> $operator for Paired<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}

operator!(Add::add, Sub::sub, Mul::mul, Div::div);

impl<L: Lanes> Lanes for Paired<L> {
    type Wide = Paired<L::Wide>;
    const COUNT: usize = 2 * L::COUNT;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self(L::splat(value), L::splat(value))
    }

    #[inline(always)]
    fn load(source: &[f32]) -> Self {
        Self(L::load(source), L::load(&source[L::COUNT..]))
    }

    #[inline(always)]
    fn store(self, target: &mut [MaybeUninit<f32>]) {
        self.0.store(target);
        self.1.store(&mut target[L::COUNT..]);
    }

    #[inline(always)]
    fn stream(self, target: &mut AlignedLine, first: usize) {
        self.0.stream(target, first);
        self.1.stream(target, first + L::COUNT);
    }

    #[inline(always)]
    fn finish_streaming() {
        L::finish_streaming();
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add(factor.0, term.0), self.1.mul_add(factor.1, term.1))
    }

    #[inline(always)]
    fn negated_mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0.negated_mul_add(factor.0, term.0), self.1.negated_mul_add(factor.1, term.1))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn or_at_least(self, least: Self) -> Self {
        Self(self.0.or_at_least(least.0), self.1.or_at_least(least.1))
    }

    #[inline(always)]
    fn below(self, limit: Self) -> u32 {
        self.0.below(limit.0) | self.1.below(limit.1) << L::COUNT
    }

    #[inline(always)]
    fn if_negative(self, negative: Self, other: Self) -> Self {
        Self(self.0.if_negative(negative.0, other.0), self.1.if_negative(negative.1, other.1))
    }

    #[inline(always)]
    fn replaced(self, bits: u32, other: Self) -> Self {
        Self(self.0.replaced(bits, other.0), self.1.replaced(bits >> L::COUNT, other.1))
    }

    #[inline(always)]
    fn widen(self) -> Self::Wide {
        Paired(self.0.widen(), self.1.widen())
    }

    #[inline(always)]
    fn narrow(wide: Self::Wide) -> Self {
        Self(L::narrow(wide.0), L::narrow(wide.1))
    }
}

impl<W: WideLanes> WideLanes for Paired<W> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(W::splat(value), W::splat(value))
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_sub(factor.0, term.0), self.1.mul_sub(factor.1, term.1))
    }
}
