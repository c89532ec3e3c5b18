//! The exactness of the numbers of a mechanism: rational, in a number field, or rounded.

use super::single_loop::closing_transformation;
use crate::algebra::drawn::{self, Drawn};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number_field::Algebraic;
use crate::algebra::residue_field::{Places, Residue};
use crate::catalogue::entry::Case;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::degree::{Degree, degree, general_closing};
use crate::elimination::point_reach;
use crate::exact::{OverField, general_rank, has_triple};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop, Variable};
use crate::kinematics::data_field::DataField;
use crate::kinematics::motion::Motion;
use crate::verdict::Proof;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// The exactness of the numbers of a loop.
pub(super) enum Data {
    /// Rationals.
    Rational,
    /// Elements of a number field.
    Field(Box<FieldLoop>),
    /// Some are rounded.
    Rounded,
}

/// A loop over a number field, without its closing transformation.
pub(super) struct FieldLoop {
    field: DataField,
    open: OpenLoop<Algebraic>,
    places: Places,
    modular: OpenLoop<Residue>,
}

/// A loop modulo a prime.
pub(super) enum Modular {
    /// The prime of the run.
    Drawn(ClosedLoop<Drawn>),
    /// A prime ideal of the field of the numbers.
    Field(ClosedLoop<Residue>),
}

impl Data {
    /// Classifies the numbers of a chain and of a case.
    pub(super) fn of(chain: &Chain, layout: &Layout, case: Option<&Case>) -> Self {
        let pose = case.and_then(|case| case.pose.as_ref());
        let input = case.and_then(|case| case.input.first());
        let given = input.map(|input| input.value.in_closed_form());
        if given == Some(None) {
            return Self::Rounded;
        }
        match DataField::of(chain, pose, given.flatten().as_ref()) {
            Some(field) if field.is_rational() => Self::Rational,
            Some(field) => FieldLoop::of(field, chain, layout).map_or(Self::Rounded, |own| Self::Field(Box::new(own))),
            None => Self::Rounded,
        }
    }

    /// Returns whether the numbers are rounded, so that equations between them prove nothing.
    pub(super) fn is_rounded(&self) -> bool {
        matches!(self, Self::Rounded)
    }

    /// Returns the proof that three neighbouring axes of a chain are parallel or meet in a point; `None` where they do not.
    pub(super) fn triple(
        &self,
        chain: &Chain,
        layout: &Layout,
        enclosed: Option<&OpenLoop<Enclosure>>,
    ) -> Option<Proof> {
        if let Self::Field(own) = self {
            return has_triple(&own.open).then_some(Proof::Proved);
        }
        // A wrist does not depend on an irrational twist elsewhere: what is enclosed by 0 alone is 0.
        if self.is_rounded() && enclosed.is_some_and(has_triple) {
            return Some(Proof::Proved);
        }
        let open: OpenLoop<Rational> = chain.try_open_loop(layout).ok().flatten()?;
        // Incidences of rounded axes may be those of the rounded numbers only.
        has_triple(&open).then_some(Proof::Proved.of_rounded(self.is_rounded()))
    }

    /// The loop at a general pose or input modulo a prime.
    pub(super) fn general(
        &self,
        open: Option<&OpenLoop<Drawn>>,
        locked: Option<Variable>,
        choice: i32,
    ) -> Option<Modular> {
        match self {
            Self::Field(own) => own.modular(|| general_closing(locked, choice)),
            _ => Some(Modular::Drawn(open?.close(&general_closing(locked, choice)?))),
        }
    }

    /// The loop of a case modulo a prime.
    pub(super) fn modular(&self, open: Option<&OpenLoop<Drawn>>, chain: &Chain, case: &Case) -> Option<Modular> {
        match self {
            Self::Field(own) => {
                let closing = own.closing(chain, case)?;
                own.modular(|| own.reduced(&closing))
            }
            _ => Some(Modular::Drawn(open?.close(&closing_transformation(case).ok()?))),
        }
    }
}

impl FieldLoop {
    fn of(field: DataField, chain: &Chain, layout: &Layout) -> Option<Self> {
        let open = chain.open_loop_over(layout, &field).ok().flatten()?;
        let places = Places::draw(&field.0, &mut ChaCha8Rng::seed_from_u64(drawn::seed()))?;
        let image = |motion: &Motion<Algebraic>| reduced(&places, motion);
        let constants: Option<Vec<_>> = open.constants.iter().map(image).collect();
        let modular = OpenLoop {
            variables: open.variables,
            constants: constants?.try_into().ok()?,
            before_gap: image(&open.before_gap)?,
            after_gap: image(&open.after_gap)?,
        };
        Some(Self { field, open, places, modular })
    }

    /// Returns the closing transformation.
    fn closing(&self, chain: &Chain, case: &Case) -> Option<Motion<Algebraic>> {
        if let Some(pose) = &case.pose {
            return Some(self.field.pose(chain, pose)?.inverse());
        }
        let Some(input) = case.input.first() else { return Some(Motion::identity()) };
        self.field.motion(&input.value.in_closed_form()?)
    }

    fn reduced(&self, motion: &Motion<Algebraic>) -> Option<Motion<Residue>> {
        reduced(&self.places, motion)
    }

    /// The loop modulo the prime, which becomes that of the thread.
    fn modular(&self, closing: impl FnOnce() -> Option<Motion<Residue>>) -> Option<Modular> {
        self.places.enter();
        Some(Modular::Field(self.modular.close(&closing()?)))
    }

    /// The exact side of a case, whose constants are enclosed.
    pub(super) fn exact(&self, chain: &Chain, case: &Case, enclosed: &ClosedLoop<Enclosure>) -> Option<OverField> {
        let closed = self.open.close(&self.closing(chain, case)?);
        OverField::of(self.field.0.clone(), closed, enclosed)
    }
}

/// A motion at the first place over the prime.
fn reduced(places: &Places, motion: &Motion<Algebraic>) -> Option<Motion<Residue>> {
    places.enter();
    let place = places.generators().first()?;
    motion.map(|x| Some(Residue::reduced(x)?.eval(place)))
}

impl Modular {
    /// The number of solutions by cuts, until it is at most `enough`; `other` is the same arm at another general pose.
    pub(super) fn degree(&self, other: Option<&Self>, enough: usize) -> Option<Degree> {
        match (self, other) {
            (Self::Drawn(own), Some(Self::Drawn(other))) => degree(own, Some(other), enough),
            (Self::Field(own), Some(Self::Field(other))) => degree(own, Some(other), enough),
            (Self::Drawn(own), _) => degree(own, None, enough),
            (Self::Field(own), _) => degree(own, None, enough),
        }
    }

    /// Returns the number of positions of the centre of a spherical joint.
    pub(super) fn reach(&self, spherical: usize) -> Option<usize> {
        match self {
            Self::Drawn(own) => point_reach::count(own, spherical),
            Self::Field(own) => point_reach::count(own, spherical),
        }
    }

    /// The way to the ring of the loop.
    pub(super) fn plan(&self) -> Option<Plan> {
        match self {
            Self::Drawn(own) => Plan::of(own),
            Self::Field(own) => Plan::of(own),
        }
    }

    /// The rank of the joint screws in general position.
    pub(super) fn rank(&self) -> usize {
        match self {
            Self::Drawn(own) => general_rank(own),
            Self::Field(own) => general_rank(own),
        }
    }
}

/// Whether the pose or the input of a case is rational.
pub(super) fn is_rational(case: &Case) -> bool {
    case.pose.as_ref().is_none_or(|pose| pose.given.is_none() && pose.closed.is_none())
        && super::single_loop::is_exact(case)
}
