'use strict';

/// Replicates by what is said of them: a flag, or where and why they failed.
function reasonsOf(replicates) {
  const reasons = new Map();
  const put = (reason, replicate) => reasons.set(reason, [...reasons.get(reason) ?? [], replicate]);
  for (const replicate of replicates) {
    const {failure, flags} = replicate;
    if (failure) put(`failed in ${failure.where}: ${failure.why}`, replicate);
    else for (const flag of unique(flags)) put(flag, replicate);
  }
  return [...reasons].sort((a, b) => b[1].length - a[1].length || (a[0] < b[0] ? -1 : 1));
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
