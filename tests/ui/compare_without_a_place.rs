use terraline::word::World;

fn hits<W: World>(y: W::Height, surface: W::Height) -> bool {
    y < surface
}

fn is_at_the_eye<W: World>(x: W::Ground, eye: W::Ground) -> bool {
    x == eye
}

fn main() {}
