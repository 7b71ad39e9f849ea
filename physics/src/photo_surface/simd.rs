//! All `unsafe` code of the kernel: x86 vector registers, stores past the caches, and write-only memory.
//!
//! The register types implement `Lanes` by one instruction an operation. They are safe to use because they are private
//! to this file and only `x86::avx2` and `x86::avx512` name them: every method is inlined into one of these two, which
//! are entered after the processor was asked (see [`Instructions`]).

use std::mem::MaybeUninit;

use super::instructions::Instructions;
use super::lanes::{AlignedLine, LaneWork, OutputLine, Portable};

/// Does the work with registers of the given instructions, or with portable ones where the processor lacks them.
pub(super) fn run<W: LaneWork>(instructions: Instructions, work: W) -> W::Output {
    match instructions {
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx512 if instructions.are_available() => {
            // SAFETY: the processor has the instructions.
            unsafe { x86::avx512(work) }
        }
        #[cfg(target_arch = "x86_64")]
        Instructions::Avx2 if instructions.are_available() => {
            // SAFETY: the processor has the instructions.
            unsafe { x86::avx2(work) }
        }
        _ => work.run::<Portable<f32>>(),
    }
}

/// Memory that is only written, typed as memory that need not be initialised.
pub(super) fn write_only(memory: &mut [f32]) -> &mut [MaybeUninit<f32>] {
    let (start, length) = (memory.as_mut_ptr().cast(), memory.len());
    // SAFETY: same memory, same layout, same borrow. The kernel only ever writes initialised values to it.
    unsafe { std::slice::from_raw_parts_mut(start, length) }
}

/// The lines as aligned lines if all of them are aligned; otherwise the lines as they are.
pub(super) fn aligned<const N: usize>(
    mut streams: [&mut [OutputLine]; N],
) -> Result<[&mut [AlignedLine]; N], [&mut [OutputLine]; N]> {
    fn cast(lines: &mut [OutputLine]) -> &mut [AlignedLine] {
        // SAFETY: both types are as many values, none of which need be initialised.
        unsafe { lines.align_to_mut() }.1
    }
    if streams.iter_mut().all(|lines| cast(lines).len() == lines.len()) { Ok(streams.map(cast)) } else { Err(streams) }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use std::arch::x86_64::*;
    use std::mem::MaybeUninit;
    use std::ops::{Add, Div, Mul, Sub};

    use super::super::lanes::{AlignedLine, LaneWork, Lanes, WideLanes};
    use super::super::paired::Paired;

    #[target_feature(enable = "avx2,fma")]
    pub(super) fn avx2<W: LaneWork>(work: W) -> W::Output {
        work.run::<Paired<F32x8>>()
    }

    #[target_feature(enable = "avx512f,avx2,fma")]
    pub(super) fn avx512<W: LaneWork>(work: W) -> W::Output {
        work.run::<Paired<F32x16>>()
    }

    #[derive(Clone, Copy)]
    struct F32x8(__m256);
    #[derive(Clone, Copy)]
    struct F64x8([__m256d; 2]);
    #[derive(Clone, Copy)]
    struct F32x16(__m512);
    #[derive(Clone, Copy)]
    struct F64x16([__m512d; 2]);

    macro_rules! operator {
        ($type:ident, $operator:ident::$method:ident, $instruction:ident) => {
            impl $operator for $type {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    // SAFETY: registers of this type exist only where the processor has the instructions.
                    Self(unsafe { $instruction(self.0, other.0) })
                }
            }
        };
        (pair $type:ident, $operator:ident::$method:ident, $instruction:ident) => {
            impl $operator for $type {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    let ([a, b], [c, d]) = (self.0, other.0);
                    // SAFETY: registers of this type exist only where the processor has the instructions.
                    Self(unsafe { [$instruction(a, c), $instruction(b, d)] })
                }
            }
        };
    }

    operator!(F32x8, Add::add, _mm256_add_ps);
    operator!(F32x8, Sub::sub, _mm256_sub_ps);
    operator!(F32x8, Mul::mul, _mm256_mul_ps);
    operator!(F32x8, Div::div, _mm256_div_ps);
    operator!(F32x16, Add::add, _mm512_add_ps);
    operator!(F32x16, Sub::sub, _mm512_sub_ps);
    operator!(F32x16, Mul::mul, _mm512_mul_ps);
    operator!(F32x16, Div::div, _mm512_div_ps);
    operator!(pair F64x8, Sub::sub, _mm256_sub_pd);
    operator!(pair F64x8, Mul::mul, _mm256_mul_pd);
    operator!(pair F64x16, Sub::sub, _mm512_sub_pd);
    operator!(pair F64x16, Mul::mul, _mm512_mul_pd);

    /// The methods of [`Lanes`] that differ between the widths by the instructions' names only.
    macro_rules! lanes {
        ($wide:ident, $count:literal, $splat:ident, $load:ident, $store:ident, $stream:ident, $mul_add:ident,
         $negated_mul_add:ident, $sqrt:ident, $max:ident) => {
            type Wide = $wide;
            const COUNT: usize = $count;

            #[inline(always)]
            fn splat(value: f32) -> Self {
                // SAFETY: called only from functions that have the instructions enabled.
                Self(unsafe { $splat(value) })
            }

            #[inline(always)]
            fn load(source: &[f32]) -> Self {
                let source = &source[..$count];
                // SAFETY: as many values are there as the register takes; no alignment is needed.
                Self(unsafe { $load(source.as_ptr()) })
            }

            #[inline(always)]
            fn store(self, target: &mut [MaybeUninit<f32>]) {
                let target = &mut target[..$count];
                // SAFETY: as many values fit there as the register holds; no alignment is needed.
                unsafe { $store(target.as_mut_ptr().cast(), self.0) }
            }

            #[inline(always)]
            fn stream(self, target: &mut AlignedLine, first: usize) {
                assert!(first.is_multiple_of($count), "a register is streamed to where it is aligned");
                let target = &mut target.0[first..first + $count];
                // SAFETY: as many values fit there as the register holds, and since the line is aligned to 64
                // bytes and `first` is a multiple of the register's width, the address is aligned to it.
                unsafe { $stream(target.as_mut_ptr().cast(), self.0) }
            }

            #[inline(always)]
            fn finish_streaming() {
                // SAFETY: an instruction of every x86-64 processor.
                unsafe { _mm_sfence() }
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                // SAFETY: registers of this type exist only where the processor has the instructions.
                Self(unsafe { $mul_add(self.0, factor.0, term.0) })
            }

            #[inline(always)]
            fn negated_mul_add(self, factor: Self, term: Self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $negated_mul_add(self.0, factor.0, term.0) })
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: as above.
                Self(unsafe { $sqrt(self.0) })
            }

            #[inline(always)]
            fn or_at_least(self, least: Self) -> Self {
                // SAFETY: as above. The instruction gives its second operand if either is not a number.
                Self(unsafe { $max(self.0, least.0) })
            }
        };
    }

    impl Lanes for F32x8 {
        lanes!(
            F64x8,
            8,
            _mm256_set1_ps,
            _mm256_loadu_ps,
            _mm256_storeu_ps,
            _mm256_stream_ps,
            _mm256_fmadd_ps,
            _mm256_fnmadd_ps,
            _mm256_sqrt_ps,
            _mm256_max_ps
        );

        #[inline(always)]
        fn abs(self) -> Self {
            // SAFETY: as above.
            Self(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
        }

        #[inline(always)]
        fn below(self, limit: Self) -> u32 {
            // SAFETY: as above.
            let bits = unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, limit.0)) };
            bits.cast_unsigned()
        }

        #[inline(always)]
        fn if_negative(self, negative: Self, other: Self) -> Self {
            // SAFETY: as above. The sign bit decides; −0 may take either, both being equal there.
            Self(unsafe { _mm256_blendv_ps(other.0, negative.0, self.0) })
        }

        #[inline(always)]
        fn replaced(self, bits: u32, other: Self) -> Self {
            // SAFETY: as above.
            Self(unsafe {
                let lane_bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
                let chosen = _mm256_and_si256(_mm256_set1_epi32(bits.cast_signed()), lane_bits);
                let replaced = _mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, lane_bits));
                _mm256_blendv_ps(self.0, other.0, replaced)
            })
        }

        #[inline(always)]
        fn widen(self) -> F64x8 {
            // SAFETY: as above.
            F64x8(unsafe {
                [_mm256_cvtps_pd(_mm256_castps256_ps128(self.0)), _mm256_cvtps_pd(_mm256_extractf128_ps::<1>(self.0))]
            })
        }

        #[inline(always)]
        fn narrow(wide: F64x8) -> Self {
            let [low, high] = wide.0;
            // SAFETY: as above.
            Self(unsafe { _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low)) })
        }
    }

    impl Lanes for F32x16 {
        lanes!(
            F64x16,
            16,
            _mm512_set1_ps,
            _mm512_loadu_ps,
            _mm512_storeu_ps,
            _mm512_stream_ps,
            _mm512_fmadd_ps,
            _mm512_fnmadd_ps,
            _mm512_sqrt_ps,
            _mm512_max_ps
        );

        #[inline(always)]
        fn abs(self) -> Self {
            // SAFETY: as above.
            Self(unsafe { _mm512_abs_ps(self.0) })
        }

        #[inline(always)]
        fn below(self, limit: Self) -> u32 {
            // SAFETY: as above.
            u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, limit.0) })
        }

        #[inline(always)]
        fn if_negative(self, negative: Self, other: Self) -> Self {
            // SAFETY: as above.
            Self(unsafe {
                let below_zero = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, _mm512_setzero_ps());
                _mm512_mask_blend_ps(below_zero, other.0, negative.0)
            })
        }

        #[inline(always)]
        fn replaced(self, bits: u32, other: Self) -> Self {
            // SAFETY: as above.
            Self(unsafe { _mm512_mask_blend_ps(bits as __mmask16, self.0, other.0) })
        }

        #[inline(always)]
        fn widen(self) -> F64x16 {
            // SAFETY: as above.
            F64x16(unsafe {
                let upper = _mm512_extractf64x4_pd::<1>(_mm512_castps_pd(self.0));
                [_mm512_cvtps_pd(_mm512_castps512_ps256(self.0)), _mm512_cvtps_pd(_mm256_castpd_ps(upper))]
            })
        }

        #[inline(always)]
        fn narrow(wide: F64x16) -> Self {
            let [low, high] = wide.0;
            // SAFETY: as above.
            Self(unsafe {
                let lower = _mm512_castps_pd(_mm512_castps256_ps512(_mm512_cvtpd_ps(low)));
                let upper = _mm256_castps_pd(_mm512_cvtpd_ps(high));
                _mm512_castpd_ps(_mm512_insertf64x4::<1>(lower, upper))
            })
        }
    }

    impl WideLanes for F64x8 {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: called only from functions that have the instructions enabled.
            Self([unsafe { _mm256_set1_pd(value) }; 2])
        }

        #[inline(always)]
        fn mul_sub(self, factor: Self, term: Self) -> Self {
            let ([a, b], [c, d], [e, f]) = (self.0, factor.0, term.0);
            // SAFETY: as above.
            Self(unsafe { [_mm256_fmsub_pd(a, c, e), _mm256_fmsub_pd(b, d, f)] })
        }
    }

    impl WideLanes for F64x16 {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: called only from functions that have the instructions enabled.
            Self([unsafe { _mm512_set1_pd(value) }; 2])
        }

        #[inline(always)]
        fn mul_sub(self, factor: Self, term: Self) -> Self {
            let ([a, b], [c, d], [e, f]) = (self.0, factor.0, term.0);
            // SAFETY: as above.
            Self(unsafe { [_mm512_fmsub_pd(a, c, e), _mm512_fmsub_pd(b, d, f)] })
        }
    }
}
