'use strict';

const numberInText = /[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?/g;

/// Texts that differ only in their numbers, as one text with the range of each number.
function withRanges(texts) {
  const numbers = texts.map((text) => text.match(numberInText) ?? []);
  let index = 0;
  return texts[0].replace(numberInText, () => {
    const column = unique(numbers.map((list) => list[index])).sort((a, b) => Number(a) - Number(b));
    index += 1;
    return column.length === 1 ? column[0] : `${column[0]} to ${column[column.length - 1]}`;
  });
}

/// Replicates by what is said of them: a flag, or where and why they failed. Failures whose texts differ only in their
/// numbers are one group.
function reasonsOf(replicates) {
  const groups = new Map();
  const put = (kind, text, replicate) => {
    const group = groups.get(kind) ?? {texts: [], members: []};
    groups.set(kind, {texts: [...group.texts, text], members: [...group.members, replicate]});
  };
  for (const replicate of replicates) {
    const {failure, flags} = replicate;
    const text = failure && `failed in ${failure.where}: ${failure.why}`;
    if (failure) put(text.replace(numberInText, '#'), text, replicate);
    else for (const flag of unique(flags)) put(flag, flag, replicate);
  }
  const reasons = [...groups.values()].map(({texts, members}) => [withRanges(texts), members]);
  return reasons.sort((a, b) => b[1].length - a[1].length || (a[0] < b[0] ? -1 : 1));
}

/// Of each sweep point how many, and which.
function membersList(data, members) {
  return element('ul', {className: 'note'}, ...unique(members.map(({row}) => row)).map((row) => {
    const own = members.filter((replicate) => replicate.row === row);
    const of = data.replicates.filter((replicate) => replicate.row === row).length;
    return element('li', {}, ...rich(data.rows[row].label), `, ${own.length} of ${of}: `,
      own.map(({name}) => name).join(', '));
  }));
}

/// Failed and flagged replicates, grouped by reason; the largest group first.
function drawReservations(data) {
  const place = document.getElementById('reservations'), groups = reasonsOf(data.replicates);
  if (groups.length === 0) return;
  place.hidden = false;
  place.append(element('p', {className: 'note'}, 'A replicate with several flags is listed under each of them.'));
  for (const [reason, members] of groups) {
    const excludes = data.exclude.includes(reason) ? ', excluded from means' : '';
    place.append(element('details', {className: 'reason', open: members.length <= mostDrawn},
      element('summary', {}, element('b', {}, reason), `: ${counted(members.length, 'replicate')}${excludes}`),
      membersList(data, members)));
  }
}
