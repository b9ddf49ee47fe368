//! The queue between units.
#![cfg(rtl)]

use std::collections::VecDeque;

use proptest::prelude::*;
use terraline_hdl::Model;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_queue_hands_out_what_was_put_in(
        name in prop::sample::select(vec![("queue_1", 1), ("queue_5", 5)]),
        moves in prop::collection::vec((any::<bool>(), any::<bool>(), any::<u16>()), 1..400),
    ) {
        let (name, depth) = name;
        let mut rtl = Model::new(name);
        let [reset, put, item, ready] =
            ["reset", "put", "in_item", "out_ready"].map(|name| rtl.port(name));
        let [valid, out] = ["out_valid", "out_item"].map(|name| rtl.port(name));
        rtl.set(reset, 1);
        rtl.edge();
        rtl.set(reset, 0);
        let mut expected = VecDeque::new();
        for (puts, takes, word) in moves {
            let puts = puts && expected.len() < depth;
            rtl.set(put, puts.into());
            rtl.set(item, word.into());
            rtl.set(ready, takes.into());
            rtl.settle();
            prop_assert_eq!(rtl.is(valid), !expected.is_empty());
            if let Some(&oldest) = expected.front() {
                prop_assert_eq!(rtl.get(out), u64::from(oldest));
            }
            if takes {
                expected.pop_front();
            }
            if puts {
                expected.push_back(word);
            }
            rtl.edge();
        }
    }
}
