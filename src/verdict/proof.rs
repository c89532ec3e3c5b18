//! The proof of a verdict, and a stable code for the reason that its text gives.

/// The kind of proof of a verdict, in one word. It stands beside [`super::Status`] and is never mixed with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// A theorem whose every assumption was checked on the data: facts of the form "not 0 modulo p", "not 0 in an
    /// interval", identities over the integers. It holds for every value of the numbers that had to be rounded.
    Proved,
    /// A count modulo primes drawn at run time.
    Probable {
        /// Upper bound on the probability that the verdict is wrong.
        error: f64,
        /// The seed of the primes: the same seed repeats the count.
        seed: u64,
    },
    /// A theorem on the rounded numbers of the file, not on the numbers that were rounded.
    RoundedData,
    /// A measurement.
    None,
}

impl Proof {
    /// The word of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::Probable { .. } => "probable",
            Self::RoundedData => "rounded-data",
            Self::None => "none",
        }
    }

    /// Returns whether a theorem applies to the data as they are.
    #[must_use]
    pub fn is_proved(self) -> bool {
        self == Self::Proved
    }

    /// Returns the proof for data of which some numbers had to be rounded, where the verdict rests on their exact values.
    #[must_use]
    pub fn of_rounded(self, is_rounded: bool) -> Self {
        if is_rounded && self.is_proved() { Self::RoundedData } else { self }
    }
}

/// The reason of a verdict as a code that scripts can rely on. The text beside it may be reworded at any time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// The number of certified solutions equals the bound for all mechanisms of this kind.
    GeneralBoundMet,
    /// The number of certified solutions equals the bound of the geometry at any pose or input, by exact incidences of its axes.
    GeometryBoundMet,
    /// Every root of the exact closure polynomial of this case belongs to exactly one listed solution.
    ExactRootsMatched,
    /// Every box of angles is proved empty, or holds exactly one listed solution; real solutions only.
    BoxesExhausted,
    /// The closure polynomial in a joint angle has as many real zeros as there are certified solutions, and all are simple; real
    /// solutions only.
    RealZerosMatched,
    /// The number of solutions equals a count modulo primes.
    CountMet,
    /// The closure equations have no solution at all.
    NoSolution,
    /// The links together are too short for the pose or input.
    OutOfReach,
    /// No pose of the moving platform has legs of these lengths.
    NoPoseHasLegs,
    /// The solutions form a self-motion.
    SelfMotion,
    /// The joint axes are dependent in every configuration.
    StructurallyDeficient,
    /// A singular solution has an unknown multiplicity.
    UnknownMultiplicity,
    /// A solution has no certificate.
    NoCertificate,
    /// Two solutions are not proved to be distinct.
    NotDistinct,
    /// A solution is neither proved real nor proved complex.
    RealOrComplex,
    /// No real configuration reaches the pose exactly; whether one comes near it is not decided.
    NearNotDecided,
    /// More solutions were found than can exist.
    TooMany,
    /// Fewer solutions were found than there may be.
    TooFew,
    /// Only real solutions were looked for, and their number is not known.
    OnlyReal,
    /// The mechanism is beyond what is implemented.
    Unsupported,
    /// Nothing binds the joints of an open chain.
    OpenChain,
    /// The joint screws span the algebra of a group of motions, or of two, at a configuration.
    GroupOfMotions,
    /// The closure equations vanish beyond the order that an isolated configuration can have.
    OrderExceedsBound,
    /// At a certified configuration the six closure equations are independent.
    RegularConfiguration,
    /// The parameters satisfy the conditions of a family of loops that move.
    FamilyOfMobileLoops,
    /// No curve of configurations: every joint variable takes finitely many values.
    NoCurve,
    /// One link spans more than all others together.
    LinkTooLong,
    /// The loop closes to rounding through a range of a joint. This is a measurement.
    CertifiedSweep,
    /// The motion that was found has no real configuration where it was looked.
    ComplexMotion,
    /// Neither a motion nor its absence was proved.
    NotDecided,
    /// A sweep: between all neighbouring inputs the closure polynomial proves what becomes of every branch.
    BranchesProved,
    /// A sweep: there is no closure polynomial in input and output for this kind of loop.
    NoExactRoute,
    /// A sweep: the loop may move while its input stands still.
    InputLocked,
    /// A sweep: at a critical input it is not decided what the branches do.
    SingularNotDecided,
    /// A sweep: the branches that were found are not those of the closure polynomial.
    BranchesNotMatched,
    /// A sweep: it was stopped before the end of its range.
    Interrupted,
    /// Cells of a parameter: the closure polynomial proves the number of real modes in each.
    CellsProved,
    /// Cells of a parameter: the closure polynomial is interpolated, and no bound of its degree is used.
    ProbablePolynomial,
    /// Cells of a parameter: at some sample point the real roots of the closure polynomial are not the real modes found.
    CellsNotMatched,
}

impl Code {
    /// The code of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::GeneralBoundMet => "general-bound-met",
            Self::GeometryBoundMet => "geometry-bound-met",
            Self::ExactRootsMatched => "exact-roots-matched",
            Self::BoxesExhausted => "boxes-exhausted",
            Self::RealZerosMatched => "real-zeros-matched",
            Self::CountMet => "count-met",
            Self::NoSolution => "no-solution",
            Self::OutOfReach => "out-of-reach",
            Self::NoPoseHasLegs => "no-pose-has-legs",
            Self::SelfMotion => "self-motion",
            Self::StructurallyDeficient => "structurally-deficient",
            Self::UnknownMultiplicity => "unknown-multiplicity",
            Self::NoCertificate => "no-certificate",
            Self::NotDistinct => "not-distinct",
            Self::RealOrComplex => "real-or-complex",
            Self::NearNotDecided => "near-not-decided",
            Self::TooMany => "too-many",
            Self::TooFew => "too-few",
            Self::OnlyReal => "only-real",
            Self::Unsupported => "unsupported",
            Self::OpenChain => "open-chain",
            Self::GroupOfMotions => "group-of-motions",
            Self::OrderExceedsBound => "order-exceeds-bound",
            Self::RegularConfiguration => "regular-configuration",
            Self::FamilyOfMobileLoops => "family-of-mobile-loops",
            Self::NoCurve => "no-curve",
            Self::LinkTooLong => "link-too-long",
            Self::CertifiedSweep => "certified-sweep",
            Self::ComplexMotion => "complex-motion",
            Self::NotDecided => "not-decided",
            Self::BranchesProved => "branches-proved",
            Self::NoExactRoute => "no-exact-route",
            Self::InputLocked => "input-locked",
            Self::SingularNotDecided => "singular-not-decided",
            Self::BranchesNotMatched => "branches-not-matched",
            Self::Interrupted => "interrupted",
            Self::CellsProved => "cells-proved",
            Self::ProbablePolynomial => "probable-polynomial",
            Self::CellsNotMatched => "cells-not-matched",
        }
    }
}
