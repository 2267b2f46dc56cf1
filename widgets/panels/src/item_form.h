#pragma once

#include "lorica/panels/property_form.h"

namespace lorica::panels {

/// The form for one thing of the study. It may outlive the thing while it is not refreshed.
PropertyForm* makeItemForm(document::StudyDocument& document, const document::ItemRef& item, QWidget* parent);

}  // namespace lorica::panels
