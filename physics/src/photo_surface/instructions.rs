//! The instruction sets that the kernel can compute with, and which of them this processor has.

/// The instructions that a [`Kernel`](super::Kernel) computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// The instructions that every processor of the target has: SSE2 on x86-64, NEON on AArch64.
    Portable,
    /// AVX2 and FMA: eight vertices at a time.
    Avx2,
    /// AVX-512: sixteen vertices at a time.
    Avx512,
}

impl Instructions {
    /// Instruction sets, the slowest first.
    pub const ALL: [Self; 3] = [Self::Portable, Self::Avx2, Self::Avx512];

    /// True if this processor has them.
    pub fn are_available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => is_x86_feature_detected!("avx512f") && Self::Avx2.are_available(),
            #[cfg(not(target_arch = "x86_64"))]
            Self::Avx2 | Self::Avx512 => false,
        }
    }

    /// Widest instructions that this processor has.
    pub fn fastest() -> Self {
        Self::ALL.into_iter().rfind(|instructions| instructions.are_available()).unwrap_or(Self::Portable)
    }
}
