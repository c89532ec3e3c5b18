//! Sparse matrices in block triangular form: the determinant is the product of those of the blocks.

use super::minors::is_odd;

/// The rows and columns of a block on the diagonal, as many of either.
pub(super) struct Block {
    pub(super) rows: Vec<usize>,
    pub(super) columns: Vec<usize>,
}

/// Returns the blocks that cannot be split further, and whether the permutation that brings them to the diagonal is odd; `None`
/// where every term of the determinant vanishes.
///
/// # Shape
/// For each row of a square matrix of at most 64 rows, the set of columns in which it has entries.
///
/// # Source
/// Duff, Reid 1978, An implementation of Tarjan's algorithm for the block triangularization of a matrix, ACM Transactions
/// on Mathematical Software 4.
pub(super) fn blocks(pattern: &[u64]) -> Option<(Vec<Block>, bool)> {
    let size = pattern.len();
    let mut row_of: Vec<Option<usize>> = vec![None; size];
    for row in 0..size {
        let mut tried = 0;
        if !assign(pattern, row, &mut row_of, &mut tried) {
            return None;
        }
    }
    let mut column_of = vec![0; size];
    for (column, row) in row_of.iter().enumerate() {
        column_of[row.unwrap_or(0)] = column;
    }
    // A row leads to those whose columns it has entries in; rows that lead to each other belong together.
    let mut reach: Vec<u64> = pattern.iter().map(|&set| rows_of(set, &row_of)).collect();
    for via in 0..size {
        for row in 0..size {
            if reach[row] >> via & 1 == 1 {
                reach[row] |= reach[via];
            }
        }
    }
    let (mut blocks, mut done): (Vec<Block>, u64) = (Vec::new(), 0);
    for row in 0..size {
        if done >> row & 1 == 1 {
            continue;
        }
        let together = |&other: &usize| reach[row] >> other & 1 == 1 && reach[other] >> row & 1 == 1;
        let rows: Vec<usize> = (row..size).filter(together).collect();
        done |= rows.iter().fold(0, |set, &row| set | 1 << row);
        let mut columns: Vec<usize> = rows.iter().map(|&row| column_of[row]).collect();
        columns.sort_unstable();
        blocks.push(Block { rows, columns });
    }
    let flat = |part: fn(&Block) -> &Vec<usize>| blocks.iter().flat_map(part).copied().collect::<Vec<usize>>();
    let odd = is_odd(&flat(|block| &block.rows)) != is_odd(&flat(|block| &block.columns));
    Some((blocks, odd))
}

/// Returns the rows to which the columns of a set belong.
fn rows_of(set: u64, row_of: &[Option<usize>]) -> u64 {
    let members = row_of.iter().enumerate().filter(|(column, _)| set >> column & 1 == 1);
    members.fold(0, |rows, (_, row)| rows | 1 << row.unwrap_or(0))
}

/// Gives a row a column of its own, other rows moving on to other columns.
fn assign(pattern: &[u64], row: usize, row_of: &mut [Option<usize>], tried: &mut u64) -> bool {
    let mut free = pattern[row] & !*tried;
    while free != 0 {
        let column = free.trailing_zeros() as usize;
        *tried |= 1 << column;
        if row_of[column].is_none_or(|other| assign(pattern, other, row_of, tried)) {
            row_of[column] = Some(row);
            return true;
        }
        free = pattern[row] & !*tried;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The members of a set.
    fn set(columns: &[u32]) -> u64 {
        columns.iter().fold(0, |set, column| set | 1 << column)
    }

    #[test]
    fn a_triangular_matrix_falls_into_single_entries_whatever_its_order() {
        // Row 1 has one entry, then row 2, then row 0.
        let (blocks, odd) = blocks(&[set(&[0, 1, 2]), set(&[2]), set(&[1, 2])]).unwrap();
        let places: Vec<(usize, usize)> = blocks.iter().map(|block| (block.rows[0], block.columns[0])).collect();
        assert_eq!(places, [(0, 0), (1, 2), (2, 1)]);
        assert!(odd);
    }

    #[test]
    fn what_cannot_be_split_stays_together() {
        let cycle = [set(&[0, 1]), set(&[1, 2]), set(&[2, 0]), set(&[0, 3])];
        let (blocks, odd) = blocks(&cycle).unwrap();
        let rows: Vec<&[usize]> = blocks.iter().map(|block| block.rows.as_slice()).collect();
        assert_eq!(rows, [&[0, 1, 2][..], &[3]]);
        assert!(!odd);
    }

    #[test]
    fn matrices_without_a_term_have_no_blocks() {
        assert!(blocks(&[set(&[0]), set(&[0])]).is_none());
        assert!(blocks(&[set(&[0, 1]), 0]).is_none());
    }
}
