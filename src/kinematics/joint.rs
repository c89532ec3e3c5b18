//! The types of joints: the one table of their letters and variables.

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

impl JointKind {
    /// Every kind, in the order in which messages list their letters.
    pub const ALL: [Self; 6] =
        [Self::Revolute, Self::Prismatic, Self::Cylindrical, Self::Helical, Self::Universal, Self::Spherical];

    /// The letter in files and tables.
    #[must_use]
    pub fn letter(self) -> &'static str {
        match self {
            Self::Revolute => "R",
            Self::Prismatic => "P",
            Self::Cylindrical => "C",
            Self::Helical => "H",
            Self::Spherical => "S",
            Self::Universal => "U",
        }
    }

    /// The kind with this letter.
    #[must_use]
    pub fn from_letter(letter: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.letter() == letter)
    }

    /// Its variables, in the order in which solutions list them.
    #[must_use]
    pub fn variables(self) -> &'static [Variable] {
        use Variable::{Rotation, Translation};
        match self {
            Self::Revolute | Self::Helical => &[Rotation],
            Self::Prismatic => &[Translation],
            Self::Cylindrical => &[Rotation, Translation],
            Self::Universal => &[Rotation, Rotation],
            Self::Spherical => &[Rotation, Rotation, Rotation],
        }
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
        match self {
            Self::Revolute | Self::Prismatic | Self::Cylindrical | Self::Helical => true,
            Self::Spherical | Self::Universal => false,
        }
    }

    /// Returns the names of the axes of its rotations, where it has several.
    #[must_use]
    pub fn turns(self) -> &'static [&'static str] {
        match self {
            Self::Revolute | Self::Prismatic | Self::Cylindrical | Self::Helical => &[],
            Self::Universal => &["z", "x"],
            Self::Spherical => &["z", "x", "z'"],
        }
    }

    /// Returns whether an angle or a distance given for this joint identifies one of its variables.
    #[must_use]
    pub fn takes(self, wanted: Variable) -> bool {
        self.has_one_axis() && self.variables().contains(&wanted)
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
    /// The number, from 1, of a rotation of a joint with several axes; 0 for other joints.
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
        let about = self.turn.checked_sub(1).and_then(|turn| self.kind.turns().get(turn)).unwrap_or(&"");
        format!("{letter}{}{about}", self.joint)
    }

    /// Returns the number of its joint; rotations of a joint with several axes have a second number, as `2_1`.
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
            assert_eq!(kind.turns().is_empty(), kind.has_one_axis());
            assert!(kind.has_one_axis() || kind.turns().len() == kind.freedoms());
        }
        assert_eq!(JointKind::from_letter("X"), None);
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
