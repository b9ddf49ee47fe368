//! Measurements on frames and on the engines that drew them.

pub mod compare;
pub mod ssim;
