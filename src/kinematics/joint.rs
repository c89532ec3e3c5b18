//! The types of joints: the one table of everything in which they differ.

/// The quantity that one joint variable measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// Rotation about the z axis, an angle in radians.
    Rotation,
    /// Translation along the z axis, a length.
    Translation,
}

impl Variable {
    /// The word of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Rotation => "angle",
            Self::Translation => "distance",
        }
    }
}

/// The kind of a joint, by the motions that it allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// R: one rotation.
    Revolute,
    /// P: one translation.
    Prismatic,
    /// C: rotation about and translation along one axis.
    Cylindrical,
    /// H: a screw, its translation proportional to its rotation.
    Helical,
    /// S: a spherical joint, rotations about z, x and z again.
    Spherical,
    /// U: two crossing revolutes, about z and about x.
    Universal,
}

/// An axis of the frame of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The x axis.
    X,
    /// The z axis.
    Z,
}

impl Axis {
    /// The letter and, unless it is the z axis, the rotation that carries the z axis into it.
    #[must_use]
    pub const fn row(self) -> (&'static str, Option<[[i32; 3]; 3]>) {
        match self {
            Self::X => ("x", Some([[0, 0, 1], [0, 1, 0], [-1, 0, 0]])),
            Self::Z => ("z", None),
        }
    }
}

/// What the constant d or theta of a DH joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConstant {
    /// A number that the file has to state.
    Stated,
    /// A number that is 0 unless the file states it.
    Optional,
    /// The offset of the variable, 0 unless the file states it.
    Offset,
    /// The joint has no such constant: its variables have that motion.
    Absent,
}

impl DhConstant {
    /// The key of this constant d, if there is one.
    #[must_use]
    pub fn key_of_d(self) -> Option<&'static str> {
        match self {
            Self::Stated | Self::Optional => Some("d"),
            Self::Offset => Some("d0"),
            Self::Absent => None,
        }
    }

    /// The keys of this constant theta and of its half-angle tangent, if there is one.
    #[must_use]
    pub fn keys_of_theta(self) -> Option<[&'static str; 2]> {
        match self {
            Self::Stated | Self::Optional => Some(["theta", "tan_half_theta"]),
            Self::Offset => Some(["theta0", "tan_half_theta0"]),
            Self::Absent => None,
        }
    }
}

/// A row of the table: everything in which one type of joint differs from another.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The letter in files and tables.
    pub letter: &'static str,
    /// The letter with its article: `an R joint`.
    pub called: &'static str,
    /// Its variables, in the order in which solutions list them.
    pub variables: &'static [Variable],
    /// The axis about or along which each of its variables moves.
    pub axes: &'static [Axis],
    /// The constant d of a DH joint.
    pub d: DhConstant,
    /// The constant theta of a DH joint.
    pub theta: DhConstant,
    /// Whether a pitch that the file states ties its translation to its rotation: its motion is not algebraic.
    pub has_pitch: bool,
    /// What stands in its place in a list of screw axes, where one axis does not determine it.
    pub among_screws: Option<&'static str>,
}

impl JointKind {
    /// Every kind, in the order in which messages list their letters.
    pub const ALL: [Self; 6] =
        [Self::Revolute, Self::Prismatic, Self::Cylindrical, Self::Helical, Self::Universal, Self::Spherical];

    /// Its row of the table.
    #[must_use]
    pub const fn row(self) -> Row {
        use Axis::{X, Z};
        use DhConstant::{Absent, Offset, Optional, Stated};
        use Variable::{Rotation, Translation};
        const SIMPLE: Row = Row {
            letter: "R",
            called: "an R joint",
            variables: &[Rotation],
            axes: &[Z],
            d: Stated,
            theta: Offset,
            has_pitch: false,
            among_screws: None,
        };
        match self {
            Self::Revolute => SIMPLE,
            Self::Prismatic => {
                Row { letter: "P", called: "a P joint", variables: &[Translation], d: Offset, theta: Stated, ..SIMPLE }
            }
            Self::Cylindrical => Row {
                letter: "C",
                called: "a C joint",
                variables: &[Rotation, Translation],
                axes: &[Z, Z],
                d: Offset,
                ..SIMPLE
            },
            Self::Helical => Row { letter: "H", called: "an H joint", has_pitch: true, ..SIMPLE },
            Self::Spherical => Row {
                letter: "S",
                called: "an S joint",
                variables: &[Rotation, Rotation, Rotation],
                axes: &[Z, X, Z],
                d: Optional,
                theta: Absent,
                ..SIMPLE
            },
            Self::Universal => Row {
                letter: "U",
                called: "a U joint",
                variables: &[Rotation, Rotation],
                axes: &[Z, X],
                d: Optional,
                theta: Absent,
                among_screws: Some("its two R joints"),
                ..SIMPLE
            },
        }
    }

    /// The letter in files and tables.
    #[must_use]
    pub fn letter(self) -> &'static str {
        self.row().letter
    }

    /// The kind with this letter.
    #[must_use]
    pub fn from_letter(letter: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.letter() == letter)
    }

    /// The letters of the kinds that `are` so, as a list of words: `R, P and C`.
    #[must_use]
    pub fn letters(are: impl Fn(Self) -> bool, and: &str) -> String {
        let letters: Vec<&str> = Self::ALL.into_iter().filter(|kind| are(*kind)).map(Self::letter).collect();
        match letters.as_slice() {
            [before @ .., last] if !before.is_empty() => format!("{} {and} {last}", before.join(", ")),
            all => all.concat(),
        }
    }

    /// Its variables, in the order in which solutions list them.
    #[must_use]
    pub fn variables(self) -> &'static [Variable] {
        self.row().variables
    }

    /// Returns the number of its variables.
    #[must_use]
    pub fn freedoms(self) -> usize {
        self.variables().len()
    }

    /// Returns whether all its motions are about or along a single axis, so that giving an angle or a distance identifies its
    /// variable.
    #[must_use]
    pub fn has_one_axis(self) -> bool {
        self.row().axes.iter().all(|axis| *axis == Axis::Z)
    }

    /// Returns whether it turns about or slides along one axis, without a pitch: R, P and C.
    #[must_use]
    pub fn is_plain(self) -> bool {
        self.has_one_axis() && !self.row().has_pitch
    }

    /// Returns whether it only translates, so that it has a direction but no place.
    #[must_use]
    pub fn only_translates(self) -> bool {
        self.variables().iter().all(|variable| *variable == Variable::Translation)
    }

    /// Returns whether an angle or a distance given for this joint identifies one of its variables.
    #[must_use]
    pub fn takes(self, wanted: Variable) -> bool {
        self.has_one_axis() && self.variables().contains(&wanted)
    }

    /// The name of the axis of one of its variables, where it has several axes: `z`, `x`, and `z'` for z again.
    fn axis_name(self, index: usize) -> String {
        let Some(axis) = self.row().axes.get(index).filter(|_| !self.has_one_axis()) else { return String::new() };
        let again = self.row().axes[..index].iter().filter(|other| *other == axis).count();
        axis.row().0.to_owned() + &"'".repeat(again)
    }
}

/// A variable of a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointVariable {
    /// Its joint, counted from 1.
    pub joint: usize,
    /// The kind of that joint.
    pub kind: JointKind,
    /// Its kind.
    pub variable: Variable,
    /// The number, from 1, of a variable of a joint with several axes; 0 for other joints.
    pub turn: usize,
}

impl JointVariable {
    /// The variables of joints, in joint order.
    #[must_use]
    pub fn of(kinds: &[JointKind]) -> Vec<Self> {
        let of_joint = |(joint, kind): (usize, &JointKind)| {
            let kind = *kind;
            let turn = move |index: usize| if kind.has_one_axis() { 0 } else { index + 1 };
            let all = kind.variables().iter().enumerate();
            all.map(move |(index, variable)| Self { joint, kind, variable: *variable, turn: turn(index) })
        };
        (1..).zip(kinds).flat_map(of_joint).collect()
    }

    /// Its name in tables: `q1`, of a C joint `q3` and `d3`, of joints with several axes `q2z`.
    #[must_use]
    pub fn name(&self) -> String {
        let beside_rotation = self.kind.variables().len() > 1 && self.variable == Variable::Translation;
        let letter = if beside_rotation { 'd' } else { 'q' };
        let axis = self.turn.checked_sub(1).map_or(String::new(), |index| self.kind.axis_name(index));
        format!("{letter}{}{axis}", self.joint)
    }

    /// Returns the number of its joint; variables of a joint with several axes have a second number, as `2_1`.
    #[must_use]
    pub fn number(&self) -> String {
        if self.turn == 0 { self.joint.to_string() } else { format!("{}_{}", self.joint, self.turn) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_name_kinds() {
        for kind in JointKind::ALL {
            assert_eq!(JointKind::from_letter(kind.letter()), Some(kind));
            assert_eq!(kind.row().axes.len(), kind.freedoms());
            assert!(kind.row().called.ends_with(&format!(" {} joint", kind.letter())));
            // An angle about z that is stated, or an offset of one, is that of a single axis.
            assert_eq!(kind.row().theta == DhConstant::Absent, !kind.has_one_axis());
        }
        assert_eq!(JointKind::from_letter("X"), None);
        assert_eq!(JointKind::letters(JointKind::is_plain, "or"), "R, P or C");
    }

    #[test]
    fn variables_are_named_in_joint_order() {
        let kinds = ["R", "C", "U", "P", "S"].map(|letter| JointKind::from_letter(letter).expect("a letter"));
        let variables = JointVariable::of(&kinds);
        let names: Vec<String> = variables.iter().map(JointVariable::name).collect();
        assert_eq!(names, ["q1", "q2", "d2", "q3z", "q3x", "q4", "q5z", "q5x", "q5z'"]);
        let numbers: Vec<String> = variables.iter().map(JointVariable::number).collect();
        assert_eq!(numbers, ["1", "2", "2", "3_1", "3_2", "4", "5_1", "5_2", "5_3"]);
    }
}
