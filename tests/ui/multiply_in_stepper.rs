use terraline::word::{Site, World};

fn step<W: World>(height: W::Height, weight: W::Weight, site: Site) -> W::Height {
    height.multiply(weight, site)
}

fn main() {}
