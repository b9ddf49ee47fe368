//! The names of the registers. Their table (formats, meaning, bounds) is in `setup::table`.

/// Class of a register: registers of one class have one word type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// View vectors and denominators.
    View,
    /// Horizontal positions in cells.
    Ground,
    /// Heights.
    Height,
    /// Kernel weights and slopes.
    Weight,
    /// Light and colour.
    Tone,
}

impl Class {
    /// All classes in the order of the data flow.
    pub const ALL: [Self; 5] = [Self::View, Self::Ground, Self::Height, Self::Weight, Self::Tone];

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::View => "view",
            Self::Ground => "ground",
            Self::Height => "height",
            Self::Weight => "weight",
            Self::Tone => "tone",
        }
    }
}

macro_rules! registers {
    ($($(#[$doc:meta])* $variant:ident $name:literal $class:ident,)*) => {
        /// A register of the processor, by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum Register { $($(#[$doc])* $variant,)* }

        impl Register {
            /// All registers in the order of the data flow.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// Number of registers.
            pub const COUNT: usize = Self::ALL.len();

            /// Name in scene files, reports and hardware.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// The class whose word type it has.
            pub fn class(self) -> Class {
                match self { $(Self::$variant => Class::$class,)* }
            }
        }
    };
}

registers! {
    /// View vector, x in cells.
    ViewX "view_x" View,
    /// View vector, y in height units.
    ViewY "view_y" View,
    /// View vector, z in cells.
    ViewZ "view_z" View,
    /// Denominator of the projection, positive towards the plane.
    Denominator "denominator" View,
    /// Position on the ground, x in cells: entry, ray, hit.
    GroundX "ground_x" Ground,
    /// Position on the ground, z in cells.
    GroundZ "ground_z" Ground,
    /// Step of the ray in x.
    DGroundX "dground_x" Ground,
    /// Step of the ray in z.
    DGroundZ "dground_z" Ground,
    /// Height of the ray.
    RayY "ray_y" Height,
    /// Step of the ray in y.
    DRayY "dray_y" Height,
    /// A node of the height map.
    Node "node" Height,
    /// Interpolated height, and the two lerps before it.
    Surface "surface" Height,
    /// Slope against x, negated: x of the unnormalised normal.
    SlopeX "slope_x" Height,
    /// Slope against z, negated.
    SlopeZ "slope_z" Height,
    /// Kernel weight.
    Weight "weight" Weight,
    /// Derivative of the kernel weight.
    WeightSlope "weight_slope" Weight,
    /// Normal scaled to at most one, and its squared length.
    Normal "normal" Tone,
    /// Light: ambient share plus diffuse share.
    Shade "shade" Tone,
    /// Height as a place on the ramp, in segments.
    Ramp "ramp" Tone,
    /// A colour channel, 0..=255.
    Channel "channel" Tone,
}

impl Register {
    /// Whether results in this register are rounded as its format says. All others are loaded to
    /// nearest, and rounded as the algorithm says or not at all.
    pub fn is_rounded(self) -> bool {
        match self.class() {
            // Coefficients and sums of them; quotients and halvings are floored, steps go to nearest.
            Class::View | Class::Ground => false,
            Class::Height => matches!(self, Self::Surface | Self::SlopeX | Self::SlopeZ),
            Class::Weight => self == Self::Weight,
            Class::Tone => true,
        }
    }

    /// The register whose format this one takes, because the two meet in one adder.
    pub fn follows(self) -> Option<Self> {
        match self {
            Self::DGroundX => Some(Self::GroundX),
            Self::DGroundZ => Some(Self::GroundZ),
            Self::DRayY => Some(Self::RayY),
            Self::Surface | Self::SlopeX | Self::SlopeZ => Some(Self::Node),
            Self::WeightSlope => Some(Self::Weight),
            Self::Shade | Self::Ramp | Self::Channel => Some(Self::Normal),
            _ => None,
        }
    }
}

/// What one entry of `[format]` is for: a class, or one register. Registers that follow another
/// one take its format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Registers {
    /// All registers of a class.
    Class(Class),
    /// One register, with those that follow it.
    One(Register),
}

impl Registers {
    /// All classes, then all registers.
    pub fn all() -> impl Iterator<Item = Self> {
        let registers = Register::ALL.iter().map(|&register| Self::One(register));
        Class::ALL.into_iter().map(Self::Class).chain(registers)
    }

    /// The class or else the register of this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|registers| registers.name() == name)
    }

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Class(class) => class.name(),
            Self::One(register) => register.name(),
        }
    }

    /// Whether a rounding asked for them acts anywhere.
    pub fn are_rounded(self) -> bool {
        Register::ALL.iter().any(|&register| self.contains(register) && register.is_rounded())
    }

    /// Whether a register is among them.
    pub fn contains(self, register: Register) -> bool {
        match self {
            Self::Class(class) => register.class() == class,
            Self::One(leader) => register.follows().unwrap_or(register) == leader,
        }
    }
}

impl std::fmt::Display for Register {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
