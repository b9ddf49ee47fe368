//! Units
/// x
pub struct UnitPlan;
