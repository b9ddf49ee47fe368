use terraline::word::World;

fn project<W: World>(x: W::View, y: W::View) -> W::View {
    x * y
}

fn main() {}
