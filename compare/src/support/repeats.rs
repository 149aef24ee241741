//! What is done over and over, told once.

/// Longest stretch that is looked for.
const LONGEST: usize = 200;

/// A list in order, as stretches and how often each stands there in a row: k x k
/// positions do the same passes k x k times.
pub(crate) fn stretches<T: PartialEq>(list: &[T]) -> Vec<(usize, &[T])> {
    let mut found: Vec<(usize, &[T])> = Vec::new();
    let mut alone = 0..0;
    while alone.end < list.len() {
        let rest = &list[alone.end..];
        let lengths = 1..=(rest.len() / 2).min(LONGEST);
        let covered = |length: usize| (length * times(rest, length), std::cmp::Reverse(length));
        let best = lengths.filter(|length| times(rest, *length) > 1).max_by_key(|l| covered(*l));
        let Some(length) = best else {
            alone.end += 1;
            continue;
        };
        found.extend((!alone.is_empty()).then(|| (1, &list[alone.clone()])));
        found.push((times(rest, length), &rest[..length]));
        let end = alone.end + length * times(rest, length);
        alone = end..end;
    }
    found.extend((!alone.is_empty()).then(|| (1, &list[alone])));
    found
}

/// How often the first elements stand at the beginning of a list.
fn times<T: PartialEq>(list: &[T], length: usize) -> usize {
    list.chunks_exact(length).take_while(|stretch| *stretch == &list[..length]).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(list: &str) -> String {
        let list: Vec<char> = list.chars().collect();
        let told = stretches(&list).into_iter().map(|(times, stretch)| {
            let stretch: String = stretch.iter().collect();
            if times > 1 { format!("{times}({stretch})") } else { stretch }
        });
        told.collect()
    }

    #[test]
    fn what_is_repeated_is_told_once_and_nothing_is_lost() {
        assert_eq!(told(""), "");
        assert_eq!(told("abcde"), "abcde");
        assert_eq!(told("cubefsfsfsx"), "cube3(fs)x");
        assert_eq!(told("fppsfppsfpps"), "3(fpps)");
        assert_eq!(told("aab"), "2(a)b");
        assert_eq!(told("abab ab"), "2(ab) ab");
    }
}
